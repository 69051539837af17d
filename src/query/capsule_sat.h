#pragma once

#include "geometry/hull.h"

/// The separating axis test for a segment (a capsule's core) and a hull. Source: Gregorius 2015,
/// "Capsule vs Hull: Deep Penetration". Everything in the hull's frame, metres.
namespace contactscope {

/// Result of the test. Separations are those of the segment, not of the capsule: negative if the
/// segment overlaps the hull along that axis.
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

}  // namespace contactscope
