#include "core/convex_polygon.h"

#include <algorithm>

namespace contactscope {

std::vector<Vec2d> project(std::span<const Vec3d> points, const Vec3d& normal) {
  std::vector<Vec2d> result;
  if (points.empty()) return result;
  const Vec3d u = any_perpendicular(normal);
  const Vec3d v = normal.cross(u);
  result.reserve(points.size());
  for (const Vec3d& point : points) {
    const Vec3d offset = point - points[0];
    result.emplace_back(u.dot(offset), v.dot(offset));
  }
  return result;
}

/// Andrew's monotone chain (1979).
std::vector<Vec2d> convex_polygon(std::vector<Vec2d> points) {
  std::sort(points.begin(), points.end(), [](const Vec2d& a, const Vec2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2d> hull;
  const auto extend = [&hull](const Vec2d& point, std::size_t fixed) {
    while (hull.size() > fixed + 1 &&
           cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0) {
      hull.pop_back();
    }
    hull.push_back(point);
  };
  for (const Vec2d& point : points) extend(point, 0);
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) extend(points[i], lower);
  hull.pop_back();  // the first point again
  return hull;
}

double area_of(const std::vector<Vec2d>& polygon) {
  double doubled = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    doubled += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return polygon.size() < 3 ? 0 : 0.5 * doubled;
}

}  // namespace contactscope
