#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// Of the choices of at most max_points points that contain the deepest point, the one whose convex
/// hull, seen along the normal, has the largest area: exact but for rounding. The deepest is the
/// one of least separation, the earliest of equals; it may be inside of the hull, also of the kept
/// ones. For two points the deepest and the one farthest from it; of points on one line the two
/// extremes and the deepest, if it is neither.
///
/// The deepest comes first. When it is a corner of the patch the others follow counter-clockwise
/// seen against the normal; when it is not they go round counter-clockwise from the next deepest.
template <class S>
KeptIndices reduce_to_optimal_deepest(std::span<const ContactPoint<S>> points,
                                      const Vec3<S>& normal, const ReduceOptions& options);

}  // namespace contactscope
