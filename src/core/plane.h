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

/// Newell's normal of any flat polygon, also with collinear vertices. Its length is twice the area.
inline Vec3d newell_normal(std::span<const Vec3d> polygon) {
  Vec3d normal = Vec3d::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d& next = polygon[(i + 1) % polygon.size()];
    normal += (polygon[i] - polygon[0]).cross(next - polygon[0]);
  }
  return normal;
}

}  // namespace contactscope
