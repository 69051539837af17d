#pragma once

#include <array>

#include "query/penetration_bounds.h"

namespace contactscope {

/// A tetrahedron of the difference that holds the origin within rounding, or what stands in its way.
template <class S>
struct StartSimplex {
  int count = 0;  // 4: a tetrahedron; less: the difference reaches nowhere out of these
  std::array<DifferencePoint<S>, 4> points;
  Vec3<S> outward = Vec3<S>::UnitX();  // of count < 4: unit, across the difference
};

/// Makes a tetrahedron of a simplex that GJK ended with, whose nearest point is the origin within
/// rounding: flat tetrahedra are taken back to their largest face, and so on; what is left grows by
/// the support points that reach farthest out of it. The origin stays inside or on the border,
/// since every simplex holds the one before.
///
/// Source: van den Bergen, "Collision Detection in Interactive 3D Environments", 2003, section
/// 4.3.8. There a segment becomes two tetrahedra around it and a triangle a double pyramid; with the
/// origin on the border of one tetrahedron, EPA's first expansions add the other half.
template <class S>
StartSimplex<S> blow_up(const GjkSimplex<S>& simplex, BoundedDifference<S>& difference);

}  // namespace contactscope
