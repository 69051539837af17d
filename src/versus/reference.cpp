#include "versus/reference.h"

#include <algorithm>
#include <limits>

#include "core/at.h"
#include "core/convex_polygon.h"
#include "manifold/dispatch.h"

namespace contactscope::versus {
namespace {

double area_of_points(const std::vector<Vec3d>& points, const Vec3d& normal) {
  if (points.size() < 3) return 0;
  return contactscope::area_of(convex_polygon(project(points, normal)));
}

/// Infinite without points: how far apart shapes are is not asked of a mesh; that they are apart is known.
double deepest_of(const Manifolds<double>& manifolds) {
  double deepest = std::numeric_limits<double>::infinity();
  for (const Manifold<double>& manifold : manifolds)
    for (const ContactPoint<double>& point : manifold.points)
      deepest = std::min(deepest, point.separation);
  return deepest;
}

}  // namespace

double area_of(const trace::Manifold& manifold) {
  return area_of_points(mapped(manifold.points, &trace::Point::position), manifold.normal);
}

std::optional<double> separation_of(const lint::Placed& a, const lint::Placed& b) {
  if (const std::optional<lint::Separation> best = best_separation(a, b)) return best->distance;
  const Shape<double>&one = a.solid->shape(), &other = b.solid->shape();
  if (!can_collide(kind_of(one), kind_of(other))) return std::nullopt;
  Manifolds<double> manifolds;
  collide(one, a.pose, other, b.pose, CollideOptions{}, manifolds);
  return deepest_of(manifolds);
}

std::vector<Truth> truths_of(const lint::Solids& solids, const trace::Frame& frame) {
  std::vector<Truth> truths;
  for (const trace::Pair& pair : frame.pairs) {
    Truth& truth = truths.emplace_back();
    truth.a = pair.a;
    truth.b = pair.b;
    const auto a = lint::place(solids, &frame, pair.a, {});
    const auto b = lint::place(solids, &frame, pair.b, {});
    if (!a || !b) continue;
    truth.tolerance = lint::tolerance_of(*a, *b);
    if (const std::optional<lint::Separation> best = best_separation(*a, *b))
      truth.separation = best->distance;
    const Shape<double>&one = a->solid->shape(), &other = b->solid->shape();
    if (!can_collide(kind_of(one), kind_of(other))) continue;
    Manifolds<double> manifolds;
    CollideOptions options;  // with all points
    collide(one, a->pose, other, b->pose, options, manifolds);
    if (!truth.separation) {
      truth.separation = deepest_of(manifolds);
    } else if (manifolds.size() == 1) {
      truth.area = area_of_points(mapped(manifolds.front().points, &ContactPoint<double>::position),
                                  manifolds.front().normal);
    }
  }
  return truths;
}

}  // namespace contactscope::versus
