#pragma once

#include "core/pack.h"

namespace contactscope {

template <class S> using ContactPoints = std::span<const ContactPoint<S>>;

/// Indices into the points given to a reducer, in the order of choice.
using KeptIndices = StaticVector<int, kMaxManifoldPoints>;

class Choices;

/// A reducer's parameters. Most use only max_points.
struct ReduceOptions {
  int max_points = 4;                     // >= 1
  std::uint64_t seed = 1;                 // for a random choice
  std::span<const FeatureId> previous{};  // ids kept in the previous frame
  /// Metres: no coordinate behind the separations is larger; HullPair::scale. Separations that
  /// differ by its rounding are ties. 0: unknown; the points' own extent is used.
  double scale = 0;
  Choices* choices = nullptr;  // record of each choice; null: not recorded
};

/// A manifold reducer for more than max_points points, finite and coplanar with unit `normal`.
/// Keeps one to max_points different points. Deterministic. Call it through reduce().
template <class S>
using Reducer = KeptIndices (*)(ContactPoints<S> points, const Vec3<S>& normal,
                                const ReduceOptions& options);

/// A reducer for scenarios, the command line, studies and benchmarks, listed in its own file.
struct ReducerInfo {
  std::string name;
  std::string summary;      // one line
  Reducer<float> in_float;  // null keeps every point
  Reducer<double> in_double;
  bool remembers = false;  // uses ReduceOptions::previous
};

/// All reducers, in listing order.
const std::vector<ReducerInfo>& reducers();

/// A reducer by name; null if unknown, and for "none", which keeps every point.
const ReducerInfo* find_reducer(std::string_view name);

/// Runs a reducer on at most kMaxManifoldPoints points. Without one, or with at most max_points
/// points, keeps all in order. Keeps nothing if a number or the normal (unit) is not finite.
template <class S>
KeptIndices reduce(const ReducerInfo* reducer, ContactPoints<S> points, const Vec3<S>& normal,
                   const ReduceOptions& options);

/// The default. The talk's steps (`area`) may drop the deepest point: of overlapping hulls in
/// games, one pair in fifty then reports a depth up to 9 % too small. This also costs less.
inline constexpr const char* kDefaultReducer = "optimal_deepest";

/// Whether all positions, separations and the normal are finite, without a branch for each.
template <class S> bool all_finite(ContactPoints<S> points, const Vec3<S>& normal) {
  // Zero times a finite number is zero; times any other it is NaN.
  const S zero = S(0);
  lanes::Pack<S> sum = {};
  for (const ContactPoint<S>& point : points)
    for (int i = 0; i < 4; i += lanes::kWidth<S>) sum += zero * lanes::load(point, i);
  S total = zero * normal.x() + zero * normal.y() + zero * normal.z();
  for (int lane = 0; lane < lanes::kWidth<S>; ++lane) total += sum[lane];
  return total == zero;
}

/// Area in square metres of the convex hull of `points`, seen along unit `normal`.
double convex_area(std::span<const Vec3d> points, const Vec3d& normal);

/// The largest such area of any `max_points` points, up to rounding: the reference for reducers.
double best_convex_area(std::span<const Vec3d> points, const Vec3d& normal, int max_points);

}  // namespace contactscope
