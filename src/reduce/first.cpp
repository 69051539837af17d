#include "reduce/steps.h"

namespace contactscope {
namespace {

/// The first max_points points in the order in which clipping made them. No source: what a buffer
/// of fixed size does.
template <class S>
KeptIndices reduce_to_first(ContactPoints<S> points, const Vec3<S>& /*normal*/,
                            const ReduceOptions& options) {
  KeptIndices kept;
  const int most = std::min(count_of(points), options.max_points);
  for (int i = 0; i < most; ++i) kept.push_back(i);
  return kept;
}

}  // namespace

ReducerInfo first_reducer() {
  return {"first", "the first, in the order of clipping", &reduce_to_first<float>,
          &reduce_to_first<double>};
}

}  // namespace contactscope
