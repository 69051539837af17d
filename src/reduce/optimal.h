#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// The max_points points whose convex hull, seen along the normal, has the largest area of all such
/// choices: exact but for rounding, at O(n^2) for four points. Of two choices whose areas differ by
/// less than the rounding of S (in float some 1e-7 of the area) the smaller may be taken. For two
/// points the farthest pair, for one a support point in a fixed direction, which rolls over with
/// the smallest change of the patch least. Points that would add no area are left out: all corners
/// of the hull if there are no more than max_points, the two extremes of points on one line, one of
/// coincident ones.
///
/// Counter-clockwise seen against the normal, beginning with the deepest of those kept (the
/// earliest of equally deep ones). Separations are not looked at otherwise.
template <class S>
KeptIndices reduce_to_optimal(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                              const ReduceOptions& options);

}  // namespace contactscope
