#pragma once

#include <span>
#include <vector>

#include "core/vec3.h"

namespace contactscope {

using Vec2d = Eigen::Vector2d;

inline double cross(const Vec2d& a, const Vec2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Points seen along unit `normal`, in an orthonormal basis of the plane that depends on `normal`
/// alone. Relative to the first point, so that a place far from the origin costs no digits.
std::vector<Vec2d> project(std::span<const Vec3d> points, const Vec3d& normal);

/// Corners of the convex hull, counter-clockwise, without points on edges: one for coincident
/// points, two for points on a line.
std::vector<Vec2d> convex_polygon(std::vector<Vec2d> points);

/// Area of a convex polygon given counter-clockwise; 0 for fewer than three corners.
double area_of(const std::vector<Vec2d>& polygon);

}  // namespace contactscope
