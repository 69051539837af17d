#pragma once

#include "draw/scene/scene.h"

namespace contactscope::draw {

/// Face of a hull on which a sphere or a capsule rests.
struct FaceOfRound {
  const PlacedShape* round = nullptr;
  std::vector<Vec3d> polygon;  // world, metres
  Vec3d normal;                // outward, unit
};

/// The face of a pair whose trace has one manifold with a face axis; nothing for other pairs.
std::optional<FaceOfRound> face_of_round(const Scene& scene, const trace::Pair& pair);

/// Axis of a capsule, clipped against the side planes of a hull's face. World, metres.
struct ClippedSegment {
  std::vector<Vec3d> face;   // of the hull
  Vec3d normal;              // of the face, outward, unit
  std::vector<Vec3d> sides;  // outward unit normals of the planes through each edge along `normal`
  Vec3d axis_from, axis_to;  // of the capsule
  Vec3d from, to;            // the clipped axis

  /// Whether that side plane cuts off part of the axis.
  bool cuts(std::size_t side) const;
};

/// The clipped axis of a capsule on a hull's face; nothing for other pairs or an empty result.
std::optional<ClippedSegment> clipped_segment(const Scene& scene, const trace::Pair& pair);

}  // namespace contactscope::draw
