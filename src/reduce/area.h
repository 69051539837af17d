#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// The reducer of Gregorius 2015, "Contact Point Reduction": a support point in a fixed direction,
/// the farthest point from it, the point that makes the largest triangle, then the point that adds
/// the most area outside. More than four points go on as the fourth. Fewer than max_points come
/// back when the rest would add no area: two extremes of points on one line, one of coincident
/// ones. Separations are not looked at.
template <class S>
KeptIndices reduce_by_area(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                           const ReduceOptions& options);

/// The direction of its first step, in the plane with unit `normal`; not of unit length.
template <class S>
Vec3<S> fixed_direction(const Vec3<S>& normal);

}  // namespace contactscope
