#pragma once

#include "core/vec3.h"

namespace contactscope {

/// Three corners in one frame, metres; counter-clockwise from the front, which is ignored here.
template <class S> using Triangle = std::array<Vec3<S>, 3>;

/// Common points of two closed triangles. The interior of a triangle excludes its three edges, in
/// its own plane; a triangle without area has none.
enum class TriangleOverlapKind : std::uint8_t {
  None,      // no common point
  Touching,  // common points, but none in the interior of both: a corner or an edge of one
             // rests on the other, or one of them has no area
  Proper,    // different planes, and the interiors intersect
  Coplanar,  // one plane, and the interiors intersect: they share an area
};

template <class S> struct TriangleOverlap {
  TriangleOverlapKind kind = TriangleOverlapKind::None;
  /// True if a (b) has no area and is a segment or a point. Not computed for kind None: false.
  bool a_degenerate = false;
  bool b_degenerate = false;
  /// Touching and Proper only: the ends of the intersection; equal for a single point. An end at a
  /// corner is exactly that corner. An end where an edge meets the other triangle is on that edge,
  /// up to rounding and an error along it of at most 2^-31 of its length. Both triangles at an edge
  /// get the same bits, regardless of its direction.
  std::array<Vec3<S>, 2> segment = {Vec3<S>::Zero(), Vec3<S>::Zero()};
};

/// Intersection of two triangles. `kind` depends only on the signs of exact predicates (for the
/// valid coordinates, including all finite floats, see geometry/predicates.h). It is therefore
/// always correct for the given numbers, to the last bit and at every scale.
///
/// After Guigue and Devillers 2003, "Fast and Robust Triangle-Triangle Overlap Test Using
/// Orientation Predicates". Steps:
///   1. test the corners of each against the plane of the other: all strictly on one side is None;
///   2. all in the plane: coplanar, or one has no area;
///   3. each triangle cuts the line of both planes in an interval that ends on the two edges of its
///      lone corner. Two predicates order the ends.
/// Deviations: touching is not overlap. Two more predicates choose the ends of the segment.
template <class S> TriangleOverlap<S> triangle_overlap(const Triangle<S>& a, const Triangle<S>& b);

/// The same without a segment.
template <class S>
TriangleOverlapKind triangle_overlap_kind(const Triangle<S>& a, const Triangle<S>& b);

/// True if the corners are collinear, exactly.
template <class S> bool is_degenerate(const Triangle<S>& triangle);

}  // namespace contactscope
