#include "reduce/first.h"

#include "reduce/steps.h"

namespace contactscope {

/// No source: what a buffer of fixed size does.
template <class S>
KeptIndices reduce_to_first(std::span<const ContactPoint<S>> points, const Vec3<S>& /*normal*/,
                            const ReduceOptions& options) {
  KeptIndices kept;
  const int most = std::min(steps::count(points), options.max_points);
  for (int i = 0; i < most; ++i) kept.push_back(i);
  return kept;
}

template KeptIndices reduce_to_first(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                     const ReduceOptions&);
template KeptIndices reduce_to_first(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                     const ReduceOptions&);

}  // namespace contactscope
