#pragma once

#include <cstdint>

#include "core/pose.h"
#include "geometry/shape.h"
#include "manifold/collide_options.h"
#include "trace/decision.h"

namespace contactscope {

struct FlipOptions {
  int directions =
      16;  // ways and axes each that are tried, of which the first six are those of the normal
  std::uint64_t seed = 1;  // of the others
};

/// How little the pose of b may change until the pair has other points: other ids, more or fewer of them. For each
/// way and each axis the change is doubled from a rounding on until the points are others, and then halved between
/// the last that were the same and the first that were not (bisection); so of points that come and go within
/// a factor of two the smaller change may be missed. Axes go through the middle of the points. Up to a hundredth of the
/// smaller shape's size, in metres and radians. The poses that are tried are rounded to S as any are. Contacts are made
/// without a cache and without what was kept before.
template <class S>
trace::Flip flip_distance(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                          const Pose<S>& pose_b, const CollideOptions& options,
                          const FlipOptions& flip = {});

}  // namespace contactscope
