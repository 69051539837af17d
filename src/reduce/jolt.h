#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// As Jolt prunes contact points: the largest distance from the centre times depth, the same from
/// that point, then the extremes on both sides of the line between them. Four points at most.
template <class S>
KeptIndices reduce_like_jolt(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                             const ReduceOptions& options);

}  // namespace contactscope
