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
///
/// With `Added::Distance` the counter-example of "4th Point (5)" and "(6)": the fourth and later
/// points are the ones farthest outside an edge, however short it is. "Maximize area, not distance!"
/// A distance from an edge is the signed area over its length.
template <steps::Added added, class S>
KeptIndices reduce_from_support(ContactPoints<S> points, const Vec3<S>& normal,
                                const ReduceOptions& options) {
  if (options.choices != nullptr) [[unlikely]]
    options.choices->support(steps::fixed_direction(options.choices->normal()).normalized());
  return steps::grow_from<added>(points, normal,
                                 steps::support_point(points, steps::fixed_direction(normal)),
                                 steps::OnALine::ExchangeFirst, options);
}

/// `area` with the deepest point as the first, which is therefore always kept. Gregorius 2015,
/// "Contact Point Reduction: 1st Point": with continuous collision "we want to start with the
/// deepest point and guarantee it is in our reduced contact set". Of points on one line come back
/// the deepest and the two extremes.
template <class S>
KeptIndices reduce_by_area_from_deepest(ContactPoints<S> points, const Vec3<S>& normal,
                                        const ReduceOptions& options) {
  if (options.choices != nullptr) [[unlikely]]
    options.choices->deepest();
  return steps::grow_from<steps::Added::Area>(points, normal, steps::deepest_point(points),
                                              steps::OnALine::KeepFirst, options);
}

}  // namespace

/// The talk's.
std::vector<ReducerInfo> area_reducers() {
  using steps::Added;
  return {{"area", "a support point, the farthest, the largest triangle, the most area outside it",
           &reduce_from_support<Added::Area, float>, &reduce_from_support<Added::Area, double>},
          {"area_deepest", "as area, but the deepest first", &reduce_by_area_from_deepest<float>,
           &reduce_by_area_from_deepest<double>},
          {"distance", "as area, but the fourth is farthest from an edge",
           &reduce_from_support<Added::Distance, float>,
           &reduce_from_support<Added::Distance, double>}};
}

}  // namespace contactscope
