#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// `area` with the deepest point as the first, which is therefore always kept: the talk's choice
/// for continuous collision. Of points on one line come back the deepest and the two extremes.
template <class S>
KeptIndices reduce_by_area_from_deepest(std::span<const ContactPoint<S>> points,
                                        const Vec3<S>& normal, const ReduceOptions& options);

}  // namespace contactscope
