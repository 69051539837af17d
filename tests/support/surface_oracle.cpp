#include "support/surface_oracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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
  // Axes in the plane, along and across the longest side, avoid squaring the height of a sliver.
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if ((t[(i + 1) % 3] - t[i]).squaredNorm() > (t[(k + 1) % 3] - t[k]).squaredNorm()) k = i;
  const Point side = t[(k + 1) % 3] - t[k], apex = t[(k + 2) % 3] - t[k], w = p - t[k];
  const Real length = side.norm();
  const Point along = side / length;
  Point across = apex;
  for (int i = 0; i < 2; ++i) across -= along.dot(across) * along;
  const Real height = across.norm();
  if (!(height > 0)) return least;
  across /= height;
  const Real foot = along.dot(apex), x = along.dot(w), y = across.dot(w);
  if (y >= 0 && x * height >= y * foot && (length - x) * height >= y * (length - foot))
    least = std::min(least, (w - x * along - y * across).squaredNorm());
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
