#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// The alternative of Gregorius 2015, "Contact Point Reduction: AABB (1)": the extreme points along
/// two axes in the contact plane. The axes follow the world's, so that the choice changes when the
/// same patch turns: a diamond on its corner loses two of four points when its long diagonal lies
/// at 45 degrees to them.
template <class S>
KeptIndices reduce_to_extremes(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                               const ReduceOptions& options);

}  // namespace contactscope
