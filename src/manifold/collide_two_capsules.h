#pragma once

#include "manifold/dispatch.h"

namespace contactscope {

/// collide() for two capsules where nobody watches, from their poses to their manifold: the same bits in
/// a third of the time, for pairs where an end decides.
///
/// False, and no manifold, where the general path is to be taken: axes that cross beside each other, that
/// are nearly parallel, that meet or have no length; capsules of very different sizes; numbers that are
/// not finite; and wherever rounding might choose.
template <class S>
bool collide_two_capsules(const Capsule<S>& a, const Pose<S>& pose_a, const Capsule<S>& b,
                          const Pose<S>& pose_b, const CollideOptions& options,
                          Manifolds<S>& manifolds);

}  // namespace contactscope
