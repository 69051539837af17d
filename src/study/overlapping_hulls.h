#pragma once

#include <random>
#include <tuple>
#include <vector>

#include "core/pose.h"
#include "geometry/hull.h"
#include "study/separation_oracle.h"

namespace contactscope {

struct OverlappingHulls {
  Hull<double> a, b;
  Pose<double> b_in_a;
  double size = 1;             // metres: the longest semi-axis of both
  OracleAxis deepest;          // of least overlap
  Vec3d way = Vec3d::UnitX();  // unit, A's frame: from where B came, for methods that look back
  Vec3d turn_axis = Vec3d::UnitX();  // unit, A's frame: about which it turned
};

/// Two hulls of `vertices` points each on ellipsoids with semi-axes of 0.5 to 1 times a size of 1
/// mm to 1 km (log-uniform), turned at random, moved along a random direction until they overlap by
/// 1 to 10% of the size along it; drawn again where another axis separates them.
OverlappingHulls overlapping_hulls(std::mt19937_64& engine, int vertices);

/// A pair as one scalar sees it.
template <class S>
struct RoundedHulls {
  Hull<S> a, b;
  Pose<S> b_in_a;

  explicit RoundedHulls(const OverlappingHulls& hulls)
      : a(hull_cast<S>(hulls.a)), b(hull_cast<S>(hulls.b)), b_in_a(hulls.b_in_a.cast<S>()) {}
};

/// The cases of a study, and what each is in both scalars: RoundedHulls, or more.
template <template <class> class Rounded>
struct HullCases {
  std::vector<OverlappingHulls> exact;
  std::tuple<std::vector<Rounded<float>>, std::vector<Rounded<double>>> rounded;

  void add(const OverlappingHulls& hulls) {
    exact.push_back(hulls);
    std::apply([&](auto&... lists) { (lists.emplace_back(hulls), ...); }, rounded);
  }
  template <class S>
  const Rounded<S>& in(std::size_t i) const {
    return std::get<std::vector<Rounded<S>>>(rounded)[i];
  }
};

}  // namespace contactscope
