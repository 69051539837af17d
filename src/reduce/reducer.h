#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/manifold.h"
#include "core/static_vector.h"

namespace contactscope {

/// Indices into the points that a reducer was given, in the order of choice.
using KeptIndices = StaticVector<int, kMaxManifoldPoints>;

/// A manifold reducer. `points` share a plane with unit `normal`; at most `max_points` (>= 1) of
/// them are kept. The input is untouched and the same input gives the same answer. Fewer points
/// than max_points are all kept, in their order.
template <class S>
using Reducer = KeptIndices (*)(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                                int max_points);

/// A reducer by name, for scenarios and the command line; nullptr when there is none such.
template <class S>
Reducer<S> find_reducer(std::string_view name);

struct ReducerInfo {
  std::string name;
  std::string summary;  // one line
};

/// Every reducer, in the order in which to list them.
const std::vector<ReducerInfo>& reducers();

}  // namespace contactscope
