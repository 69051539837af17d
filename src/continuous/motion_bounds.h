#pragma once

#include "geometry/shape.h"

/// Bounds of the region that a moving shape sweeps in its step, and of the approach of two shapes.
/// Conservative: never too small, but not tight, to be fast.
namespace contactscope {

/// A rotation, followed by a rotation about a unit vector by an angle in radians.
template <class S> Quat<S> turned(const Quat<S>& rotation, const Vec3<S>& axis, S angle) {
  Quat<S> by;
  by.w() = std::cos(S(0.5) * angle);
  by.vec() = std::sin(S(0.5) * angle) * axis;
  return by * rotation;
}

/// Motion of a rigid body in a step: its pivot moves on a straight line at constant speed, and the
/// body turns about it at a constant rate. Time is a fraction of the step, from 0 to 1.
template <class S> struct Sweep {
  Pose<S> start;                           // of the shape's frame in the world's, at time 0
  Vec3<S> pivot = Vec3<S>::Zero();         // in the shape's frame, metres
  Vec3<S> displacement = Vec3<S>::Zero();  // of the pivot in the whole step, world, metres
  Vec3<S> turn = Vec3<S>::Zero();          // in the whole step: axis in the world times radians

  Pose<S> at(S time) const;

  template <class T> Sweep<T> cast() const {
    return {start.template cast<T>(), pivot.template cast<T>(), displacement.template cast<T>(),
            turn.template cast<T>()};
  }
};

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
