#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// The first max_points points in the order in which clipping made them.
template <class S>
KeptIndices reduce_to_first(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                            const ReduceOptions& options);

}  // namespace contactscope
