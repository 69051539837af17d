#pragma once

#include <cmath>

#include "core/pose.h"

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

}  // namespace contactscope
