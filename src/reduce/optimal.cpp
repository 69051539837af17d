#include "reduce/optimal.h"

#include "reduce/area.h"
#include "reduce/optimal_choice.h"
#include "reduce/steps.h"

namespace contactscope {

/// The talk grows four points one by one (Gregorius 2015, "Contact Point Reduction"); here they are
/// chosen at once. Steps: project the points into the plane and take the corners of their convex
/// hull, for no other point is a corner of the best polygon (Patch); four of them by rolling a line
/// round the hull (Shamos 1978, see best_quadrilateral()), another number by the longest chain of
/// edges (best_ring()), two by trying all pairs; go round from the deepest of them.
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
