#pragma once

#include "geometry/shape.h"
#include "manifold/collide_options.h"
#include "trace/decision.h"

namespace contactscope {

struct FlipOptions {
  int directions = 16;     // directions and axes to try; the first six are aligned with the normal
  std::uint64_t seed = 1;  // for the other directions
};

/// Smallest change of b's pose that gives the pair other points: other ids, more or fewer of them.
/// Along each direction and about each axis through the middle of the points the change is doubled,
/// starting from a rounding, until the points differ; bisection follows. So points that come and go
/// within a factor of two may hide a smaller change. The search ends at a hundredth of the smaller
/// shape's size (metres, radians). Poses are rounded to S. Contacts use no cache or previous ids.
template <class S>
trace::Flip flip_distance(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                          const Pose<S>& pose_b, const CollideOptions& options,
                          const FlipOptions& flip = {});

}  // namespace contactscope
