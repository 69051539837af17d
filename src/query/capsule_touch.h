#pragma once

#include "query/capsule_sat.h"
#include "query/gjk.h"
#include "query/hull_feature.h"

namespace contactscope {

enum class CapsuleTouchKind {
  Face,      // a face of the hull and the part of the segment over it (under it, in overlap)
  EdgePair,  // an edge of the hull and the segment, by the axis at right angles to both
  Closest,   // closest points with a vertex, or of an end of the segment with an edge
};

/// Where a segment is nearest to a hull or, in overlap, what is the shortest way out. Hull's frame,
/// metres.
template <class S>
struct CapsuleTouch {
  CapsuleTouchKind kind = CapsuleTouchKind::Face;
  HullFeature feature;  // of the hull
  S parameter = 0;      // on the segment, of its nearest or deepest point
  S distance = 0;       // of that point from the feature along the normal; negative in overlap
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from the hull to the segment
  ClippedSegment<S> clipped = {};     // kind Face: holds `parameter`
  /// The geometry that leaves the normal open; nullptr when there is one.
  const char* degenerate = nullptr;
};

/// `axes` is what capsule_sat found, with a separation of at most its reach. `scale` is that of the
/// pair: no coordinate is larger. `touching` is the distance below which rounding decides on the
/// direction between two points (metres, of the order of some roundings of `scale`). Where closest
/// points are looked for by GJK, `run` gets the steps, unless it is nullptr.
template <class S>
CapsuleTouch<S> capsule_touch(const Hull<S>& hull, const Vec3<S> (&ends)[2],
                              const CapsuleSat<S>& axes, S scale, S touching,
                              GjkRun<S>* run = nullptr);

}  // namespace contactscope
