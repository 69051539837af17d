#pragma once

#include "core/scratch.h"
#include "geometry/hull.h"

/// The separating axis test between a segment, a capsule's core, and a hull. Source: Gregorius 2015,
/// "Capsule vs Hull: Deep Penetration". Everything in the hull's frame, metres.
namespace contactscope {

/// What the test found. Separations are those of the segment, not of the capsule: negative when the
/// segment overlaps the hull along that axis.
template <class S>
struct CapsuleSat {
  int face = 0;            // of the hull, best
  S face_separation = 0;   // of the segment's lower end
  bool face_tied = false;  // with a face that looks elsewhere; of meaning in overlap

  int edge =
      -1;  // half-edge of the hull whose edge pair with the segment beats the faces; -1: none
  S edge_separation = 0;
  Vec3<S> edge_normal = Vec3<S>::UnitX();  // unit, from the hull to the segment

  bool edge_wins() const { return edge >= 0; }
  /// The largest over all axes. Above 0 a lower bound of the distance between segment and hull, and
  /// their distance where a face or two edges are closest; else the depth.
  S separation() const { return edge_wins() ? edge_separation : face_separation; }
};

/// Measures the segment between `ends`, which may have length zero. An axis must beat an earlier one
/// by more than `tie` (metres, >= 0) to replace it, faces come before edges; of faces that tie, the
/// earliest that the lower end projects into. Edges are left out when a face alone separates by more
/// than `reach`: then `separation` is any above it.
template <class S>
CapsuleSat<S> capsule_sat(const Hull<S>& hull, const Vec3<S> (&ends)[2], S reach, S tie);

}  // namespace contactscope
