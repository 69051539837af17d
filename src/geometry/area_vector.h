#pragma once

#include <algorithm>

#include "core/vec3.h"
#include "geometry/predicates.h"

namespace contactscope {

/// Area vector of a triangle: length twice the area, pointing to the side from which the corners
/// run counter-clockwise. The error is a few roundings of its own length, however thin the triangle
/// is. It is the cross product of the two shorter sides, because the difference of two long sides
/// loses a short one to rounding. For needles it is computed exactly.
inline Vec3d doubled_area(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  constexpr double kNeedle = 1e-3;  // sine of the angle between the two shorter sides
  const Vec3d ab = b - a, bc = c - b, ca = a - c;
  const double most = std::max({ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()});
  // The two shorter sides, in the order of the corners.
  const Vec3d& one = ab.squaredNorm() == most ? bc : bc.squaredNorm() == most ? ca : ab;
  const Vec3d& other = ab.squaredNorm() == most ? ca : bc.squaredNorm() == most ? ab : bc;
  const Vec3d area = one.cross(other);
  if (area.squaredNorm() > kNeedle * kNeedle * one.squaredNorm() * other.squaredNorm()) return area;
  using predicates::exact_orient2d;
  return {exact_orient2d(a, b, c, 0), exact_orient2d(a, b, c, 1), exact_orient2d(a, b, c, 2)};
}

/// Newell's area vector of a polygon, of length twice the area. All corners contribute, so three
/// that are nearly on a line do not decide alone. `point(i)` returns one of the `count` corners.
template <class Point> Vec3d doubled_area(int count, const Point& point) {
  Vec3d area = Vec3d::Zero();
  for (int i = 2; i < count; ++i) area += doubled_area(point(0), point(i - 1), point(i));
  return area;
}

}  // namespace contactscope
