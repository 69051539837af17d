#pragma once

#include "geometry/hull.h"

/// The prism over a face, bounded by the face's side planes: Gregorius 2015, "Capsule vs Hull:
/// Clipping". Hull's frame, metres. Points within `thickness` (>= 0, up to a factor of 1.8) of a
/// side plane are on it.
namespace contactscope {

/// Whether the foot of the perpendicular from `point` to the face's plane lies in the face.
template <class S>
bool projects_into(const Hull<S>& hull, int face, const Vec3<S>& point, S thickness);

/// What is left of a segment: from parameters[0] to parameters[1], both in [0, 1]; empty when they
/// are the other way round.
template <class S>
struct ClippedSegment {
  S parameters[2] = {0, 1};
  /// Half-edges of the sides that cut the two ends off; -1: the segment's own end.
  int edges[2] = {-1, -1};

  bool empty() const { return parameters[0] > parameters[1]; }
};

/// The part of the segment between two points that lies in the prism over `face`. Cyrus and Beck
/// 1978: each side plane moves one of the two ends of the interval.
template <class S>
ClippedSegment<S> clip_to_prism(const Hull<S>& hull, int face, const Vec3<S> (&ends)[2],
                                S thickness);

/// The part of the segment that lies beside an edge: between the planes at right angles to the edge
/// through its vertices. Ends that were cut off name the half-edge that leaves the vertex: the given
/// one or its twin.
template <class S>
ClippedSegment<S> clip_to_edge(const Hull<S>& hull, int half_edge, const Vec3<S> (&ends)[2]);

}  // namespace contactscope
