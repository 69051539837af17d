#pragma once

#include "query/penetration.h"

namespace contactscope {

/// The separating axis test as a penetration method: exact, and what the others are held against.
/// Two hulls by sat(), a hull and a point or segment by capsule_sat(). Two cores without volume have
/// no faces: they give Flat, across both.
template <class S>
PenetrationResult<S> sat_penetration(const SupportSet<S>& a, const SupportSet<S>& b,
                                     const Pose<S>& b_in_a);

}  // namespace contactscope
