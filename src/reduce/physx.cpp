#include "reduce/physx.h"

#include "reduce/steps.h"

namespace contactscope {

/// Behaviour of PhysX's batch reduction, written from a description. Steps: the deepest point; the
/// farthest from it; the farthest on either side of the line through both. Deviation: where a side
/// is empty three points come back.
template <class S>
KeptIndices reduce_like_physx(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                              const ReduceOptions& options) {
  const int first = steps::deepest_point(points);
  const int second = steps::farthest_from(points, first);
  return steps::two_and_both_sides(points, normal, first, second, options);
}

template KeptIndices reduce_like_physx(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                       const ReduceOptions&);
template KeptIndices reduce_like_physx(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                       const ReduceOptions&);

}  // namespace contactscope
