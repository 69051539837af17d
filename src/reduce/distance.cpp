#include "reduce/grow.h"

namespace contactscope {
namespace {

/// The counter-example of Gregorius 2015, "Contact Point Reduction: 4th Point (5)" and "(6)": as
/// `area`, but the fourth and later points are the ones farthest outside an edge, however short it
/// is. "Maximize area, not distance!" A distance from an edge is the signed area over its length.
template <class S>
KeptIndices reduce_by_distance(ContactPoints<S> points, const Vec3<S>& normal,
                               const ReduceOptions& options) {
  if (options.choices != nullptr) [[unlikely]]
    options.choices->support(steps::fixed_direction(options.choices->normal()).normalized());
  return steps::grow_from<steps::Added::Distance>(
      points, normal, steps::support_point(points, steps::fixed_direction(normal)),
      steps::OnALine::ExchangeFirst, options);
}

}  // namespace

ReducerInfo distance_reducer() {
  return {"distance", "as area, but the fourth is farthest from an edge",
          &reduce_by_distance<float>, &reduce_by_distance<double>};
}

}  // namespace contactscope
