#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// As PhysX reduces a batch of contacts: the deepest, the farthest from it, and the extremes on
/// both sides of the line between them. The deepest is always kept. Four points at most.
template <class S>
KeptIndices reduce_like_physx(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                              const ReduceOptions& options);

}  // namespace contactscope
