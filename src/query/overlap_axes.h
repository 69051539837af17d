#pragma once

#include "query/overlap.h"

namespace contactscope {

/// Builds a recorded axis from measurements along a direction of any length: the projections are
/// those of the unit direction times `length`. `offset`, metres: from A's centre to B's.
template <class S>
OverlapAxis<S> overlap_axis(OverlapAxisKind kind, int a, int b, const Vec3<S>& direction, S length,
                            const Vec3<S>& offset, S distance, S reach_a, S reach_b) {
  OverlapAxis<S> axis{kind, a, b, Vec3<S>::Zero(), length, {}, {}, 0, false, false};
  if (!(length > 0)) return axis;
  axis.direction = direction / (offset.dot(direction) < 0 ? -length : length);
  axis.interval_a = {-reach_a / length, reach_a / length};
  axis.interval_b = {(distance - reach_b) / length, (distance + reach_b) / length};
  axis.gap = (distance - (reach_a + reach_b)) / length;
  return axis;
}

}  // namespace contactscope
