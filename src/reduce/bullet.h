#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// As Bullet's persistent manifold takes points one by one: a fifth point always gets the place of
/// one of the four, never that of the deepest, and the largest area decides which. The deepest is
/// always kept; the rest depends on the order of the points. Four points at most.
template <class S>
KeptIndices reduce_like_bullet(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                               const ReduceOptions& options);

}  // namespace contactscope
