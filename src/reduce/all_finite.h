#pragma once

#include "core/pack.h"
#include "reduce/reducer.h"

namespace contactscope {

/// Whether all positions, separations and the normal are finite, without a branch for each.
template <class S> bool all_finite(ContactPoints<S> points, const Vec3<S>& normal) {
  // Zero times a finite number is zero; times any other it is NaN.
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
