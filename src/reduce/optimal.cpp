#include "reduce/optimal.h"

#include "reduce/area.h"
#include "reduce/optimal_choice.h"
#include "reduce/steps.h"

namespace contactscope {
template <class S>
KeptIndices reduce_to_optimal(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                              const ReduceOptions& options) {
  if (options.max_points == 1) {
    KeptIndices kept;
    kept.push_back(steps::support_point(points, fixed_direction(normal)));
    return kept;
  }
  const Patch<S> patch(points, normal);
  return kept_points(points, patch, largest_ring(patch, options.max_points));
}

template KeptIndices reduce_to_optimal(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                       const ReduceOptions&);
template KeptIndices reduce_to_optimal(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                       const ReduceOptions&);

}  // namespace contactscope
