#pragma once

#include "core/pack.h"
#include "reduce/reducer.h"

namespace contactscope {

/// Whether every position and separation and the normal are numbers, without a branch for each.
template <class S>
bool all_finite(ContactPoints<S> points, const Vec3<S>& normal) {
  // Zero times anything finite is zero, times anything else is not.
  const S zero = S(0);
  lanes::Pack<S> sum = {};
  for (const ContactPoint<S>& point : points) {
    for (int i = 0; i < 4; i += lanes::kWidth<S>) sum += zero * lanes::load(point, i);
  }
  S total = zero * normal.x() + zero * normal.y() + zero * normal.z();
  for (int lane = 0; lane < lanes::kWidth<S>; ++lane) total += sum[lane];
  return total == zero;
}

}  // namespace contactscope
