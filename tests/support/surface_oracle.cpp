#include "support/surface_oracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/at.h"

namespace contactscope::test {
namespace {

using Real = SurfaceOracle::Real;
using Point = SurfaceOracle::Point;

Real squared_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const Real t = std::clamp<Real>(along.dot(p - a) / along.squaredNorm(), 0, 1);
  return (p - a - t * along).squaredNorm();
}

Real squared_to_triangle(const Point& p, const std::array<Point, 3>& t) {
  Real least = std::min({squared_to_segment(p, t[0], t[1]), squared_to_segment(p, t[1], t[2]),
                         squared_to_segment(p, t[2], t[0])});
  const Point u = t[1] - t[0], v = t[2] - t[0], w = p - t[0];
  const Real uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uw = u.dot(w), vw = v.dot(w);
  const Real det = uu * vv - uv * uv;
  const Real s = (vv * uw - uv * vw) / det, r = (uu * vw - uv * uw) / det;
  if (s >= 0 && r >= 0 && s + r <= 1) least = std::min(least, (w - s * u - r * v).squaredNorm());
  return least;
}

}  // namespace

SurfaceOracle::SurfaceOracle(const std::vector<Vec3d>& vertices,
                             const std::vector<std::array<int, 3>>& triangles) {
  for (const std::array<int, 3>& triangle : triangles) {
    auto& corners = triangles_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) corners[k] = at(vertices, triangle[k]).cast<Real>();
  }
}

Real SurfaceOracle::distance(const Vec3d& point) const {
  const Point p = point.cast<Real>();
  Real least = std::numeric_limits<Real>::infinity();
  for (const auto& triangle : triangles_) least = std::min(least, squared_to_triangle(p, triangle));
  return std::sqrt(least);
}

Real SurfaceOracle::winding(const Vec3d& point) const {
  const Point p = point.cast<Real>();
  Real angle = 0;
  for (const auto& triangle : triangles_) {
    const Point a = triangle[0] - p, b = triangle[1] - p, c = triangle[2] - p;
    angle +=
        2 * std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                              b.dot(c) * a.norm() + c.dot(a) * b.norm());
  }
  return angle / (4 * std::numbers::pi_v<Real>);
}

Real SurfaceOracle::signed_distance(const Vec3d& point) const {
  return std::abs(winding(point)) > 0.5L ? -distance(point) : distance(point);
}

}  // namespace contactscope::test
