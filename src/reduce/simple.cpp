#include <utility>

#include "reduce/steps.h"

namespace contactscope {
namespace {

/// The first max_points points in the order of clipping. No source: the behaviour of a fixed-size
/// buffer.
constexpr auto reduce_to_first = []<class S>(const Candidates<S>& /*points*/,
                                             const ReduceOptions& options) {
  return steps::numbers_up_to(options.max_points);
};

/// The deepest max_points points, deepest first, equally deep ones by index. No source: the obvious
/// choice, and a bad one. Deep points are next to each other, and the manifold jumps if two points
/// exchange their depths.
constexpr auto reduce_to_deepest = []<class S>(const Candidates<S>& points,
                                               const ReduceOptions& options) {
  KeptIndices order = steps::numbers_up_to(points.count());
  std::partial_sort(
      order.begin(), order.begin() + options.max_points, order.end(), [&](int a, int b) {
        return std::pair(points.separation(a), a) < std::pair(points.separation(b), b);
      });
  return steps::first_of(order, options);
};

/// Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators": works with any
/// seed, including 0.
std::uint64_t split_mix(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15;
  std::uint64_t mixed = state;
  mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9;
  mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111eb;
  return mixed ^ (mixed >> 31);
}

/// Any max_points of the points, equally likely, by options.seed. The same on every platform.
///
/// Fisher and Yates 1938, stopped after max_points. Steps: exchange position i with a random
/// position >= i, drawn by multiplying 32 random bits by the number of positions. The bias is below
/// 1e-7. A standard distribution would differ between libraries.
constexpr auto reduce_at_random = []<class S>(const Candidates<S>& points,
                                              const ReduceOptions& options) {
  const int all = points.count();
  KeptIndices order = steps::numbers_up_to(all);
  std::uint64_t state = options.seed;
  for (int i = 0; i < options.max_points; ++i) {
    const std::uint64_t places = static_cast<std::uint64_t>(all - i);
    const std::uint64_t drawn = ((split_mix(state) >> 32) * places) >> 32;
    std::swap(at(order, i), order[static_cast<std::size_t>(i) + drawn]);
  }
  return steps::first_of(order, options);
};

}  // namespace

/// Reducers without geometry, for comparison.
std::vector<ReducerInfo> simple_reducers() {
  return {listed("deepest", "the deepest", reduce_to_deepest),
          listed("first", "the first, in the order of clipping", reduce_to_first),
          listed("random", "any, by the seed", reduce_at_random)};
}

}  // namespace contactscope
