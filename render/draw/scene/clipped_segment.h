#pragma once

#include <optional>
#include <vector>

#include "draw/scene/scene.h"

namespace contactscope::draw {

/// The face of a hull on which a sphere or a capsule rests.
struct FaceOfRound {
  const PlacedShape* round = nullptr;
  std::vector<Vec3d> polygon;  // world, metres
  Vec3d normal;                // outward, unit
};

/// Of a pair whose manifold has a face for its axis, as its trace tells; nothing of other pairs.
std::optional<FaceOfRound> face_of_round(const Scene& scene, const trace::Pair& pair);

/// How the axis of a capsule was clipped against the sides of a hull's face: as a polygon is, of two
/// corners. World, metres.
struct ClippedSegment {
  std::vector<Vec3d> face;   // of the hull
  Vec3d normal;              // of that, outward, unit
  std::vector<Vec3d> sides;  // outward, unit: of the plane through each edge along the normal
  Vec3d axis_from, axis_to;  // of the capsule
  Vec3d from, to;            // what is left of it

  /// Whether the plane of that side took a part of the axis away.
  bool cuts(std::size_t side) const;
};

/// Of a capsule on such a face; nothing of others, and where nothing is left of the axis.
std::optional<ClippedSegment> clipped_segment(const Scene& scene, const trace::Pair& pair);

}  // namespace contactscope::draw
