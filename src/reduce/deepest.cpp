#include "reduce/deepest.h"

#include "reduce/steps.h"

namespace contactscope {

/// No source: the obvious choice, and a bad one, because deep points lie side by side.
template <class S>
KeptIndices reduce_to_deepest(std::span<const ContactPoint<S>> points, const Vec3<S>& /*normal*/,
                              const ReduceOptions& options) {
  KeptIndices order;
  for (int i = 0; i < steps::count(points); ++i) order.push_back(i);
  const int most = std::min(steps::count(points), options.max_points);
  std::partial_sort(order.begin(), order.begin() + most, order.end(), [&](int a, int b) {
    const S of_a = points[static_cast<std::size_t>(a)].separation;
    const S of_b = points[static_cast<std::size_t>(b)].separation;
    return of_a < of_b || (of_a == of_b && a < b);
  });
  return steps::first_of(order, options);
}

template KeptIndices reduce_to_deepest(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                       const ReduceOptions&);
template KeptIndices reduce_to_deepest(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                       const ReduceOptions&);

}  // namespace contactscope
