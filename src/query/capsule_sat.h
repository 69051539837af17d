#pragma once

#include "query/hull_feature.h"

/// The separating axis test for a segment (a capsule's core) and a hull. Source: Gregorius 2015,
/// "Capsule vs Hull: Deep Penetration". Everything in the hull's frame, metres.
namespace contactscope {

/// Result of the test. Separations are the segment's, not the capsule's; negative in overlap.
template <class S> struct CapsuleSat {
  int face = 0;            // best face of the hull
  S face_separation = 0;   // of the segment's lower end
  bool face_tied = false;  // tied with a face of another direction; valid in overlap

  int edge = -1;  // half-edge of the hull whose edge pair beats the faces; -1: none
  S edge_separation = 0;
  Vec3<S> edge_normal = Vec3<S>::UnitX();  // unit, from the hull to the segment
  bool edge_wins() const { return edge >= 0; }
  /// Largest separation over all axes. Above 0: a lower bound of the distance between segment and
  /// hull, exact if a face or two edges are closest. Below 0: the negative depth.
  S separation() const { return edge_wins() ? edge_separation : face_separation; }
};

/// Tests the segment between `ends`, which may have length zero. An axis must beat an earlier one
/// by more than `tie` (metres, >= 0) to replace it. Faces come before edges; among tied faces, the
/// first that the lower end projects into wins. Edges are skipped if a face separates by more than
/// `reach`; `separation` is then any value above it.
template <class S>
CapsuleSat<S> capsule_sat(const Hull<S>& hull, const Vec3<S> (&ends)[2], S reach, S tie);

enum class CapsuleTouchKind {
  Face,      // a face of the hull and the part of the segment above it (below it, in overlap)
  EdgePair,  // an edge of the hull and the segment, along their common perpendicular
  Closest,   // closest points with a vertex, or between an end of the segment and an edge
};

/// A hull's closest feature to a segment, or in overlap the least depth. Hull's frame, metres.
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
