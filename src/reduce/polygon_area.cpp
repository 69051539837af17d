#include "reduce/polygon_area.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace contactscope {
namespace {

using Vec2d = Eigen::Vector2d;

double cross(const Vec2d& a, const Vec2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// In an orthonormal basis of the plane, relative to the first point so that a place far from the
/// origin costs no digits.
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

/// Andrew's monotone chain (1979): counter-clockwise, without points on edges.
std::vector<Vec2d> convex_polygon(std::vector<Vec2d> points) {
  std::sort(points.begin(), points.end(), [](const Vec2d& a, const Vec2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
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

/// Largest sum of cross products over closed chains of at most `corners` corners that begin at
/// corner `start` and go round in order. most[v] is the best open chain that ends at v.
double best_from(const std::vector<Vec2d>& polygon, std::size_t start, int corners) {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  std::vector<double> most(polygon.size(), kNone);
  most[start] = 0;
  for (int used = 2; used <= corners; ++used) {
    for (std::size_t to = polygon.size() - 1; to > start; --to) {
      for (std::size_t from = start; from < to; ++from) {
        most[to] = std::max(most[to], most[from] + cross(polygon[from], polygon[to]));
      }
    }
  }
  double best = 0;
  for (std::size_t end = start + 1; end < polygon.size(); ++end) {
    best = std::max(best, most[end] + cross(polygon[end], polygon[start]));
  }
  return best;
}

}  // namespace

double convex_area(std::span<const Vec3d> points, const Vec3d& normal) {
  return area_of(convex_polygon(project(points, normal)));
}

/// The best corners are corners of the convex hull, and twice a polygon's area is the sum of the
/// cross products along its edges: a longest path, found by dynamic programming for each first
/// corner. For four corners and n <= 16, the sizes of manifolds, this is some thousand steps.
double best_convex_area(std::span<const Vec3d> points, const Vec3d& normal, int max_points) {
  const std::vector<Vec2d> polygon = convex_polygon(project(points, normal));
  if (static_cast<int>(polygon.size()) <= max_points) return area_of(polygon);
  if (max_points < 3) return 0;
  double best = 0;
  for (std::size_t start = 0; start < polygon.size(); ++start) {
    best = std::max(best, best_from(polygon, start, max_points));
  }
  return 0.5 * best;
}

}  // namespace contactscope
