#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// As Newton prunes contacts: the two points farthest apart, found by rotating calipers, and the
/// extremes on both sides of the line between them. Four points at most.
template <class S>
KeptIndices reduce_like_newton(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                               const ReduceOptions& options);

}  // namespace contactscope
