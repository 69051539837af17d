#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// Any max_points of the points, each as likely; options.seed chooses. The same on every platform.
template <class S>
KeptIndices reduce_at_random(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                             const ReduceOptions& options);

}  // namespace contactscope
