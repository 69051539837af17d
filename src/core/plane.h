#pragma once

#include "core/vec3.h"

namespace contactscope {

/// Oriented plane: the points x with normal . x = offset. `normal` is unit, `offset` in metres.
template <class S> struct Plane {
  Vec3<S> normal = Vec3<S>::UnitX();
  S offset = 0;

  /// Signed distance in metres, positive on the side of the normal.
  S distance(const Vec3<S>& point) const { return normal.dot(point) - offset; }
  /// Foot of the perpendicular from `point`.
  Vec3<S> project(const Vec3<S>& point) const { return point - distance(point) * normal; }

  template <class T> Plane<T> cast() const {
    return {normal.template cast<T>(), static_cast<T>(offset)};
  }
};

}  // namespace contactscope
