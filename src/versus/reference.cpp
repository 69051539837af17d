#include "versus/reference.h"

#include "core/at.h"
#include "core/convex_polygon.h"
#include "lint/own_contacts.h"

namespace contactscope::versus {
namespace {

double area_of_points(const std::vector<Vec3d>& points, const Vec3d& normal) {
  if (points.size() < 3) return 0;
  return contactscope::area_of(convex_polygon(project(points, normal)));
}

}  // namespace

double area_of(const trace::Manifold& manifold) {
  return area_of_points(mapped(manifold.points, &trace::Point::position), manifold.normal);
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
    const std::optional<lint::OwnContacts> own = lint::own_contacts(*a, *b);
    if (!own) continue;
    if (!truth.separation) {
      // The distance is not computed for a mesh, only that they are separated.
      truth.separation = own->separation;
    } else if (own->manifolds.size() == 1) {
      const Manifold<double>& manifold = own->manifolds.front();
      truth.area =
          area_of_points(mapped(manifold.points, &ContactPoint<double>::position), manifold.normal);
    }
  }
  return truths;
}

}  // namespace contactscope::versus
