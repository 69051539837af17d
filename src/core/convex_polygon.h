#pragma once

#include <span>
#include <vector>

#include "core/vec3.h"

namespace contactscope {

using Vec2d = Eigen::Vector2d;

inline double cross(const Vec2d& a, const Vec2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Twice the area of a triangle, positive where a, b, c run counter-clockwise: how far c lies to the
/// left of the way from a to b, times the length of that way.
inline double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return cross(Vec2d(b - a), Vec2d(c - a));
}

/// Points seen along unit `normal`, in an orthonormal basis of the plane that depends on `normal`
/// alone. Relative to the first point, so that a place far from the origin costs no digits.
std::vector<Vec2d> project(std::span<const Vec3d> points, const Vec3d& normal);

/// Corners of the convex hull as indices of points, counter-clockwise from the leftmost one, without
/// points on edges: one for coincident points, two for points on a line.
std::vector<int> convex_outline(std::span<const Vec2d> points);

/// The same corners themselves.
std::vector<Vec2d> convex_polygon(std::vector<Vec2d> points);

/// Area of a convex polygon given counter-clockwise; 0 for fewer than three corners.
double area_of(const std::vector<Vec2d>& polygon);

}  // namespace contactscope
