#pragma once

#include <algorithm>

#include "core/vec3.h"
#include "geometry/predicates.h"

namespace contactscope {

/// The area vector of a triangle, twice its area long, counter-clockwise seen from its tip, with an error
/// of some roundings of its own length, however thin the triangle is: a needle's is worked out exactly, and
/// else it is the cross product of the two shorter sides, since of two long ones a short one is left only as
/// rounding has it.
inline Vec3d doubled_area(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  constexpr double kNeedle = 1e-3;  // sine of the angle between those sides
  const Vec3d ab = b - a, bc = c - b, ca = a - c;
  const double most = std::max({ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()});
  // Two sides in the order of the corners.
  const Vec3d& one = ab.squaredNorm() == most ? bc : bc.squaredNorm() == most ? ca : ab;
  const Vec3d& other = ab.squaredNorm() == most ? ca : bc.squaredNorm() == most ? ab : bc;
  const Vec3d area = one.cross(other);
  if (area.squaredNorm() > kNeedle * kNeedle * one.squaredNorm() * other.squaredNorm()) return area;
  using predicates::exact_orient2d;
  return {exact_orient2d(a, b, c, 0), exact_orient2d(a, b, c, 1), exact_orient2d(a, b, c, 2)};
}

/// Newell's area vector of a polygon, twice its area long: every corner counts, so that no three, perhaps
/// nearly on a line, decide alone. `point(i)` gives its `count` corners.
template <class Point>
Vec3d doubled_area(int count, const Point& point) {
  Vec3d area = Vec3d::Zero();
  for (int i = 2; i < count; ++i) area += doubled_area(point(0), point(i - 1), point(i));
  return area;
}

}  // namespace contactscope
