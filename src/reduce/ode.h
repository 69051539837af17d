#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// As ODE culls the contacts of two boxes: the deepest, then the points nearest to 90 degrees of
/// spacing from it around the centroid. The deepest is always kept. Four points.
template <class S>
KeptIndices reduce_like_ode(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                            const ReduceOptions& options);

}  // namespace contactscope
