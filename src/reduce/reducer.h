#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/manifold.h"
#include "core/static_vector.h"

namespace contactscope {

template <class S>
using ContactPoints = std::span<const ContactPoint<S>>;

/// Indices into the points that a reducer was given, in the order of choice.
using KeptIndices = StaticVector<int, kMaxManifoldPoints>;

class Choices;

/// What a reducer may go by beside the points. Most look at max_points only.
struct ReduceOptions {
  int max_points = 4;                     // >= 1
  std::uint64_t seed = 1;                 // of a random choice
  std::span<const FeatureId> previous{};  // ids that were kept in the frame before
  /// Metres: no coordinate from which the separations were computed is larger; HullPair::scale. Separations
  /// that differ by its rounding are ties. 0: not known, then no larger than the points show.
  double scale = 0;
  Choices* choices = nullptr;  // record of each choice; null when nobody watches
};

/// A manifold reducer. The points share a plane with unit `normal`, are finite, and more than
/// max_points; at most max_points different ones of them are kept, at least one. The same input gives
/// the same answer. Call it through reduce().
template <class S>
using Reducer = KeptIndices (*)(ContactPoints<S> points, const Vec3<S>& normal,
                                const ReduceOptions& options);

/// What scenarios, the command line, studies and benchmarks know of a reducer. The last function of
/// its file lists it.
struct ReducerInfo {
  std::string name;
  std::string summary;      // one line
  Reducer<float> in_float;  // nullptr keeps every point
  Reducer<double> in_double;
  bool remembers = false;  // goes by ReduceOptions::previous
};

/// Every reducer, in the order in which to list them.
const std::vector<ReducerInfo>& reducers();

/// A reducer by name; nullptr when there is none such, and of "none", which keeps every point.
const ReducerInfo* find_reducer(std::string_view name);

/// Runs a reducer on any points, at most kMaxManifoldPoints. Up to max_points of them are all kept,
/// in their order, without asking it; so are any number when it is nullptr. Nothing is kept where a
/// position, a separation or the normal (unit) is not finite.
template <class S>
KeptIndices reduce(const ReducerInfo* reducer, ContactPoints<S> points, const Vec3<S>& normal,
                   const ReduceOptions& options);

/// What reduces where nobody says otherwise. The talk's steps (`area`) may drop the deepest point: of
/// overlapping hulls of games, one pair in fifty then reports a depth up to 9 % too small. The best
/// area that has the deepest point costs less, too.
inline constexpr const char* kDefaultReducer = "optimal_deepest";

}  // namespace contactscope
