#include "reduce/reducer.h"

#include "core/convex_polygon.h"

namespace contactscope {
namespace {

/// Largest sum of cross products over closed chains of at most `corners` corners that begin at
/// corner `start`, in order. most[v] is the best open chain that ends at v.
double best_from(const std::vector<Vec2d>& polygon, std::size_t start, int corners) {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  std::vector<double> most(polygon.size(), kNone);
  most[start] = 0;
  for (int used = 2; used <= corners; ++used)
    for (std::size_t to = polygon.size() - 1; to > start; --to)
      for (std::size_t from = start; from < to; ++from)
        most[to] = std::max(most[to], most[from] + cross(polygon[from], polygon[to]));
  double best = 0;
  for (std::size_t end = start + 1; end < polygon.size(); ++end)
    best = std::max(best, most[end] + cross(polygon[end], polygon[start]));
  return best;
}

}  // namespace

double convex_area(std::span<const Vec3d> points, const Vec3d& normal) {
  return area_of(convex_polygon(project(points, normal)));
}

/// The best corners are corners of the convex hull, and twice a polygon's area is the sum of the
/// cross products along its edges. So this is a longest path, by dynamic programming for each first
/// corner. For four corners and n <= 16, the sizes of manifolds, it takes some thousand steps.
double best_convex_area(std::span<const Vec3d> points, const Vec3d& normal, int max_points) {
  const std::vector<Vec2d> polygon = convex_polygon(project(points, normal));
  if (count_of(polygon) <= max_points) return area_of(polygon);
  if (max_points < 3) return 0;
  double best = 0;
  for (std::size_t start = 0; start < polygon.size(); ++start)
    best = std::max(best, best_from(polygon, start, max_points));
  return 0.5 * best;
}

}  // namespace contactscope
