#include "reduce/random.h"

#include <utility>

#include "reduce/steps.h"

namespace contactscope {
namespace {

/// Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators": any seed will do,
/// 0 included.
std::uint64_t split_mix(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15;
  std::uint64_t mixed = state;
  mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9;
  mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111eb;
  return mixed ^ (mixed >> 31);
}

}  // namespace

/// Fisher and Yates 1938, stopped after max_points. Steps: exchange place i with a place from i on,
/// drawn by multiplying 32 random bits by the number of places: a bias of less than 1e-7, and no
/// standard distribution, which would differ between libraries.
template <class S>
KeptIndices reduce_at_random(std::span<const ContactPoint<S>> points, const Vec3<S>& /*normal*/,
                             const ReduceOptions& options) {
  KeptIndices order;
  const int all = steps::count(points);
  for (int i = 0; i < all; ++i) order.push_back(i);
  const int most = std::min(all, options.max_points);
  std::uint64_t state = options.seed;
  for (int i = 0; i < most; ++i) {
    const std::uint64_t places = static_cast<std::uint64_t>(all - i);
    const std::uint64_t drawn = ((split_mix(state) >> 32) * places) >> 32;
    std::swap(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(i) + drawn]);
  }
  return steps::first_of(order, options);
}

template KeptIndices reduce_at_random(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                      const ReduceOptions&);
template KeptIndices reduce_at_random(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                      const ReduceOptions&);

}  // namespace contactscope
