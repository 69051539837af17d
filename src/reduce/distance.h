#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// The counter-example of Gregorius 2015, "Contact Point Reduction: 4th Point (5)" and "(6)": as
/// `area`, but the fourth and later points are the ones farthest outside an edge, however short it
/// is. "Maximize area, not distance!"
template <class S>
KeptIndices reduce_by_distance(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                               const ReduceOptions& options);

}  // namespace contactscope
