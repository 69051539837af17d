#pragma once

#include <array>
#include <cstdint>

#include "core/vec3.h"

namespace contactscope {

/// Three corners in one frame, metres. The side from which they run counter-clockwise is its front,
/// which overlap does not depend on.
template <class S>
using Triangle = std::array<Vec3<S>, 3>;

/// What two closed triangles have in common. The interior of a triangle is what is left of it
/// without its three edges, in its own plane; a triangle without area has none.
enum class TriangleOverlapKind : std::uint8_t {
  None,      // no point
  Touching,  // some points, none of which is in the interior of both: a corner or an edge of one
             // rests on the other, or one of them has no area
  Proper,    // the planes differ, and the interiors meet: they cut through each other
  Coplanar,  // the planes are one, and the interiors meet: they share an area
};

template <class S>
struct TriangleOverlap {
  TriangleOverlapKind kind = TriangleOverlapKind::None;
  /// Whether a, or b, has no area, so that it is a segment or a point. Left false where `kind` is
  /// None, for which nobody has to look.
  bool a_degenerate = false;
  bool b_degenerate = false;
  /// Of kinds Touching and Proper: the ends of what the triangles share; equal for a single point.
  /// An end that is a corner is that corner, without rounding. One where an edge meets the other
  /// triangle is on this edge, off along it by at most 2^-31 of its length, and rounded; it is the
  /// same, to the bit, for both triangles at an edge, whichever way they run along it.
  std::array<Vec3<S>, 2> segment = {Vec3<S>::Zero(), Vec3<S>::Zero()};
};

/// What two triangles share, decided by the signs of exact predicates alone (geometry/predicates.h
/// says for which coordinates; every finite float is one), so that `kind` is never wrong: not for
/// one last bit, and at no scale. Corners are taken as the numbers that they are.
///
/// After Guigue and Devillers 2003, "Fast and Robust Triangle-Triangle Overlap Test Using
/// Orientation Predicates". Steps:
///   1. the corners of each against the plane of the other: all strictly on one side is None;
///   2. all in the plane: coplanar, or one has no area; see flat_triangles.h;
///   3. each cuts the line of both planes in an interval that begins and ends on the two edges from
///      its lone corner. Two predicates order the ends.
/// Deviations: touching is told from overlap, where they report both as an intersection; and the
/// segment is made of the ends that two more predicates choose.
template <class S>
TriangleOverlap<S> triangle_overlap(const Triangle<S>& a, const Triangle<S>& b);

/// The same kind without a segment.
template <class S>
TriangleOverlapKind triangle_overlap_kind(const Triangle<S>& a, const Triangle<S>& b);

/// Whether the corners are on one line, exactly.
template <class S>
bool is_degenerate(const Triangle<S>& triangle);

}  // namespace contactscope
