#include "reduce/optimal_deepest.h"

#include "reduce/optimal_choice.h"
#include "reduce/steps.h"

namespace contactscope {

template <class S>
KeptIndices reduce_to_optimal_deepest(std::span<const ContactPoint<S>> points,
                                      const Vec3<S>& normal, const ReduceOptions& options) {
  const int deepest = steps::deepest_point(points);
  Patch<S> patch(points, normal);
  const ChoiceWith<S> choice = largest_with(points, patch, deepest, options.max_points);
  return kept_points(points, patch, choice, deepest);
}

template KeptIndices reduce_to_optimal_deepest(std::span<const ContactPoint<float>>,
                                               const Vec3<float>&, const ReduceOptions&);
template KeptIndices reduce_to_optimal_deepest(std::span<const ContactPoint<double>>,
                                               const Vec3<double>&, const ReduceOptions&);

}  // namespace contactscope
