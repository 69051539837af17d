#include "reduce/steps.h"

namespace contactscope {
namespace {

/// The deepest max_points points, deepest first, equally deep ones by index. No source: the obvious
/// choice, and a bad one, because deep points lie side by side, and where two points exchange their
/// depth the manifold jumps.
template <class S>
KeptIndices reduce_to_deepest(ContactPoints<S> points, const Vec3<S>& /*normal*/,
                              const ReduceOptions& options) {
  KeptIndices order;
  for (int i = 0; i < count_of(points); ++i) order.push_back(i);
  const int most = std::min(count_of(points), options.max_points);
  std::partial_sort(order.begin(), order.begin() + most, order.end(), [&](int a, int b) {
    const S of_a = at(points, a).separation;
    const S of_b = at(points, b).separation;
    return of_a < of_b || (of_a == of_b && a < b);
  });
  return steps::first_of(order, options);
}

}  // namespace

ReducerInfo deepest_reducer() {
  return {"deepest", "the deepest", &reduce_to_deepest<float>, &reduce_to_deepest<double>};
}

}  // namespace contactscope
