#include "reduce/optimal_deepest.h"

#include "reduce/optimal_choice.h"
#include "reduce/steps.h"

namespace contactscope {

/// As reduce_to_optimal(), with one point given: Gregorius 2015 begins with the deepest, too, and
/// then takes the farthest; here the others are chosen at once. Steps: find the deepest; where it
/// is a corner of the hull, a quadrilateral with it has it at an end of a diagonal, so only
/// diagonals from it are tried (best_quadrilateral_through()); where it is not, the ring of one
/// corner less whose hull with it is the largest (best_ring_around()).
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
