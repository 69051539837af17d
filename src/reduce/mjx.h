#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// As MJX reduces a clip polygon: the first point, the farthest from it, the farthest from the line
/// of both, the farthest from the other two edges, on whichever side. Three points are left where
/// the last is one of the others. Four points at most.
template <class S>
KeptIndices reduce_like_mjx(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                            const ReduceOptions& options);

}  // namespace contactscope
