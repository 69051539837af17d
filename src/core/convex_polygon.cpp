#include "core/convex_polygon.h"

#include <algorithm>
#include <numeric>

#include "core/at.h"

namespace contactscope {

std::vector<Vec2d> project(std::span<const Vec3d> points, const Vec3d& normal) {
  const Vec3d u = any_perpendicular(normal);
  const Vec3d v = normal.cross(u);
  return mapped(points, [&](const Vec3d& point) {
    const Vec3d offset = point - points[0];
    return Vec2d(u.dot(offset), v.dot(offset));
  });
}

/// Andrew's monotone chain (1979).
std::vector<int> convex_outline(std::span<const Vec2d> points) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](int i, int j) {
    const Vec2d &a = at(points, i), &b = at(points, j);
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  const auto same = [&](int i, int j) { return at(points, i) == at(points, j); };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  if (order.size() < 3) return order;
  std::vector<int> outline;
  const auto extend = [&](int next, std::size_t fixed) {
    while (outline.size() > fixed + 1) {
      const Vec2d& last = at(points, outline.back());
      const Vec2d& before = at(points, outline[outline.size() - 2]);
      if (!(cross(last - before, at(points, next) - last) <= 0)) break;
      outline.pop_back();
    }
    outline.push_back(next);
  };
  for (const int point : order) extend(point, 0);
  const std::size_t lower = outline.size() - 1;
  for (std::size_t i = order.size() - 1; i-- > 0;) extend(order[i], lower);
  outline.pop_back();  // the first point again
  return outline;
}

std::vector<Vec2d> convex_polygon(std::vector<Vec2d> points) {
  return mapped(convex_outline(points), [&](int corner) { return at(points, corner); });
}

double area_of(const std::vector<Vec2d>& polygon) {
  double doubled = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    doubled += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return polygon.size() < 3 ? 0 : 0.5 * doubled;
}

}  // namespace contactscope
