#pragma once

#include <span>
#include <vector>

#include "core/vec3.h"

namespace contactscope {

template <class S>
using Vec2 = Eigen::Matrix<S, 2, 1>;
using Vec2d = Vec2<double>;

/// Of two vectors of two: twice the area of the triangle that they span, positive where b is to the
/// left of a.
template <class A, class B>
typename A::Scalar cross(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Twice the area of a triangle, positive where a, b, c run counter-clockwise: how far c lies to the
/// left of the way from a to b, times the length of that way.
inline double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return cross(b - a, c - a);
}

/// A plane seen along its unit normal: an orthonormal basis that depends on the normal alone, and a
/// point of the plane, relative to which a place far from the origin costs no digits.
template <class S>
struct PlaneFrame {
  Vec3<S> origin, u, v;

  PlaneFrame(const Vec3<S>& at, const Vec3<S>& normal)
      : origin(at), u(any_perpendicular(normal)), v(normal.cross(u)) {}

  Vec2<S> seen(const Vec3<S>& point) const {
    const Vec3<S> offset = point - origin;
    return {u.dot(offset), v.dot(offset)};
  }
  Vec3<S> place(const Vec2<S>& seen) const { return origin + seen.x() * u + seen.y() * v; }
};

/// Points seen in the plane with unit `normal` through the first of them.
std::vector<Vec2d> project(std::span<const Vec3d> points, const Vec3d& normal);

/// Andrew's monotone chain (1979): the corners of the convex hull of points (one at least) that are
/// sorted by x, then y; counter-clockwise. `is_left_turn` looks at three of them in a row, and says
/// so where the middle one is a corner.
template <class Points, class IsLeftTurn>
Points convex_chain(const Points& sorted, const IsLeftTurn& is_left_turn) {
  Points hull;
  std::size_t fixed = 0;
  const auto extend = [&](const auto& next) {
    while (hull.size() > fixed + 1 && !is_left_turn(hull[hull.size() - 2], hull.back(), next))
      hull.pop_back();
    hull.push_back(next);
  };
  for (const auto& point : sorted) extend(point);
  fixed = hull.size() - 1;
  for (std::size_t i = sorted.size() - 1; i-- > 0;) extend(sorted[i]);
  if (hull.size() > 1) hull.pop_back();  // the first corner again
  return hull;
}

/// Corners of the convex hull as indices of points, counter-clockwise from the leftmost one, without
/// points on edges: one for coincident points, two for points on a line.
std::vector<int> convex_outline(std::span<const Vec2d> points);

/// The same corners themselves.
std::vector<Vec2d> convex_polygon(std::vector<Vec2d> points);

/// Area of a convex polygon given counter-clockwise; 0 for fewer than three corners.
double area_of(const std::vector<Vec2d>& polygon);

}  // namespace contactscope
