#include "reduce/grow.h"

namespace contactscope {
namespace {

/// The reducer of Gregorius 2015, "Contact Point Reduction: 1st Point" to "4th Point (5)": a
/// support point in a fixed direction, the farthest point from it, the point that makes the largest
/// triangle, then the point that adds the most area outside; grow_from() has these steps from the
/// second point on. More than four points go on as the fourth. Fewer than max_points come back when
/// the rest would add no area: two extremes of points on one line, one of coincident ones.
/// Separations are not looked at. Deviation: when all points lie on one line the first is exchanged
/// for the other extreme, because the support point may lie between.
template <class S>
KeptIndices reduce_by_area(ContactPoints<S> points, const Vec3<S>& normal,
                           const ReduceOptions& options) {
  if (options.choices != nullptr) [[unlikely]]
    options.choices->support(steps::fixed_direction(options.choices->normal()).normalized());
  return steps::grow_from<steps::Added::Area>(
      points, normal, steps::support_point(points, steps::fixed_direction(normal)),
      steps::OnALine::ExchangeFirst, options);
}

}  // namespace

ReducerInfo area_reducer() {
  return {"area", "a support point, the farthest, the largest triangle, the most area outside it",
          &reduce_by_area<float>, &reduce_by_area<double>};
}

}  // namespace contactscope
