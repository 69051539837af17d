#include "core/convex_polygon.h"

namespace contactscope {

std::vector<Vec2d> project(std::span<const Vec3d> points, const Vec3d& normal) {
  if (points.empty()) return {};
  const PlaneFrame<double> plane(points[0], normal);
  return mapped(points, [&](const Vec3d& point) { return plane.seen(point); });
}

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
  return convex_chain(order, [&](int a, int b, int c) {
    return !(cross(at(points, b) - at(points, a), at(points, c) - at(points, b)) <= 0);
  });
}

std::vector<Vec2d> convex_polygon(std::vector<Vec2d> points) {
  return mapped(convex_outline(points), [&](int corner) { return at(points, corner); });
}

double area_of(const std::vector<Vec2d>& polygon) {
  double doubled = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    doubled += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return polygon.size() < 3 ? 0 : 0.5 * doubled;
}

}  // namespace contactscope
