#pragma once

#include "manifold/dispatch.h"

namespace contactscope {

/// Fast path of collide() for two capsules without a record, from poses to manifold: the same bits
/// in a third of the time, for pairs whose closest points include an end of an axis.
///
/// Returns false without a manifold where the general path is needed: closest points in the middle
/// of both axes, axes that are nearly parallel, that meet or have no length; capsules of very
/// different sizes; numbers that are not finite; and wherever rounding could decide.
template <class S>
bool collide_two_capsules(const Capsule<S>& a, const Pose<S>& pose_a, const Capsule<S>& b,
                          const Pose<S>& pose_b, const CollideOptions& options,
                          Manifolds<S>& manifolds);

}  // namespace contactscope
