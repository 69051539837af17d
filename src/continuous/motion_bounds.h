#pragma once

#include "continuous/sweep.h"
#include "geometry/aabb.h"
#include "geometry/shape.h"

/// What a shape that moves can reach in its step, and how much nearer two of them can come. Bounds:
/// never too small, and no larger than quick answers have to be.
namespace contactscope {

/// The farthest that a point of the shape is from the sweep's pivot, metres; infinite of a plane.
template <class S>
S reach_about_pivot(const Shape<S>& shape, const Vec3<S>& pivot);

/// A box in the world around all that the shape sweeps, metres, rounded outwards as world_box() does,
/// with `margin` around it.
template <class S>
Aabb<float> swept_world_box(const Shape<S>& shape, const Sweep<S>& sweep, double margin);

/// The most, metres, by which any point of one shape can come nearer to any point of the other in the
/// step. Of a plane that turns: infinite.
template <class S>
S largest_approach(const Shape<S>& a, const Sweep<S>& sweep_a, const Shape<S>& b,
                   const Sweep<S>& sweep_b);

}  // namespace contactscope
