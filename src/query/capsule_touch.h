#pragma once

#include "query/capsule_sat.h"
#include "query/gjk.h"
#include "query/hull_feature.h"

namespace contactscope {

enum class CapsuleTouchKind {
  Face,      // a face of the hull and the part of the segment above it (below it, in overlap)
  EdgePair,  // an edge of the hull and the segment, along their common perpendicular
  Closest,   // closest points with a vertex, or between an end of the segment and an edge
};

/// Closest feature of a hull to a segment, or in overlap the direction of least penetration. Hull's
/// frame, metres.
template <class S> struct CapsuleTouch {
  CapsuleTouchKind kind = CapsuleTouchKind::Face;
  HullFeature feature;  // of the hull
  S parameter = 0;      // of the segment's closest or deepest point
  S distance = 0;       // from the feature to that point along the normal; negative in overlap
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from the hull to the segment
  ClippedSegment<S> clipped = {};     // kind Face only: contains `parameter`
  /// Name of the geometry that leaves the normal undetermined; null if the normal is unique.
  const char* degenerate = nullptr;
};

/// `axes` is the result of capsule_sat with a separation of at most its reach. `scale` is an upper
/// bound of the pair's coordinates. Below the distance `touching` (metres, a few roundings of
/// `scale`) rounding determines the direction between two points. `run` receives the steps of GJK
/// if it is needed for the closest points; it may be null.
template <class S>
CapsuleTouch<S> capsule_touch(const Hull<S>& hull, const Vec3<S> (&ends)[2],
                              const CapsuleSat<S>& axes, S scale, S touching,
                              GjkRun<S>* run = nullptr);

}  // namespace contactscope
