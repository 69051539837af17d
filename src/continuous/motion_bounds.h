#pragma once

#include <cmath>

#include "continuous/sweep.h"
#include "geometry/aabb.h"
#include "geometry/shape.h"

/// Bounds of the region that a moving shape sweeps in its step, and of the approach of two shapes.
/// Conservative: never too small, but not tight, to be fast.
namespace contactscope {

/// Largest distance of the shape's points from the sweep's pivot, metres; infinite for a plane.
template <class S> S reach_about_pivot(const Shape<S>& shape, const Vec3<S>& pivot);

/// World box of the whole sweep, metres, grown by `margin` and rounded outwards like world_box().
template <class S>
Aabb<float> swept_world_box(const Shape<S>& shape, const Sweep<S>& sweep, double margin);

/// Upper bound, metres, of the distance by which a point of one shape can approach a point of the
/// other in the step. Infinite for a plane that turns.
template <class S>
S largest_approach(const Shape<S>& a, const Sweep<S>& sweep_a, const Shape<S>& b,
                   const Sweep<S>& sweep_b);

/// Casts a safe time >= 0 (no impact before it) to another scalar.
template <class S> S rounded_down(double time) {
  const S near = static_cast<S>(time);
  return static_cast<double>(near) > time ? std::nextafter(near, S(0)) : near;
}

}  // namespace contactscope
