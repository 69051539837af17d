#pragma once

#include "core/vec3.h"

namespace contactscope {

template <class S> using Vec2 = Eigen::Matrix<S, 2, 1>;
using Vec2d = Vec2<double>;

/// 2D cross product: twice the signed area of the triangle of a and b, positive if b is left of a.
template <class A, class B>
typename A::Scalar cross(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Twice a triangle's area, positive counter-clockwise: |b - a| times c's distance left of line ab.
inline double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) { return cross(b - a, c - a); }

/// 2D coordinates in a plane, relative to a point of it, so points far from the world origin lose
/// no digits. The orthonormal basis depends only on the unit normal.
template <class S> struct PlaneFrame {
  Vec3<S> origin, u, v;

  PlaneFrame(const Vec3<S>& at, const Vec3<S>& normal)
      : origin(at), u(any_perpendicular(normal)), v(normal.cross(u)) {}

  Vec2<S> seen(const Vec3<S>& point) const {
    const Vec3<S> offset = point - origin;
    return {u.dot(offset), v.dot(offset)};
  }
  Vec3<S> place(const Vec2<S>& seen) const { return origin + seen.x() * u + seen.y() * v; }
};

/// Projects points into the plane with unit `normal` through the first point.
std::vector<Vec2d> project(std::span<const Vec3d> points, const Vec3d& normal);

/// Andrew's monotone chain (1979): corners of the convex hull, counter-clockwise. `sorted`: points
/// by x, then y. `is_left_turn` takes three and returns true when the middle one is a corner.
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

/// Indices of the convex hull's corners, counter-clockwise from the leftmost one. Points on edges
/// are left out: coincident points give one corner, points on a line give two.
std::vector<int> convex_outline(std::span<const Vec2d> points);

/// The same corners as points.
std::vector<Vec2d> convex_polygon(std::vector<Vec2d> points);

/// Area of a convex polygon given counter-clockwise; 0 for fewer than three corners.
double area_of(const std::vector<Vec2d>& polygon);

}  // namespace contactscope
