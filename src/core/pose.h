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

/// Rigid placement of a local frame in a parent frame: x_parent = R x_local + p. `rotation` is a
/// unit quaternion, `position` in metres. `b_in_a` maps b's frame to a's.
template <class S> struct Pose {
  Quat<S> rotation = Quat<S>::Identity();
  Vec3<S> position = Vec3<S>::Zero();

  /// Point, local to parent.
  Vec3<S> transform(const Vec3<S>& point) const { return rotation * point + position; }
  /// Direction, local to parent.
  Vec3<S> rotate(const Vec3<S>& direction) const { return rotation * direction; }
  /// Point, parent to local.
  Vec3<S> inverse_transform(const Vec3<S>& point) const {
    return rotation.conjugate() * Vec3<S>(point - position);
  }
  /// Direction, parent to local.
  Vec3<S> inverse_rotate(const Vec3<S>& direction) const {
    return rotation.conjugate() * direction;
  }

  template <class T> Pose<T> cast() const {
    return {rotation.template cast<T>(), position.template cast<T>()};
  }
};

/// The pose of b in a's frame, from both poses in one parent frame. The positions are subtracted
/// first, so two close bodies far from the origin lose no further precision.
template <class S> Pose<S> relative_pose(const Pose<S>& a, const Pose<S>& b) {
  return {a.rotation.conjugate() * b.rotation, a.inverse_transform(b.position)};
}

/// The pose of c in the parent of b, from c in b and b in its parent.
template <class S> Pose<S> compose(const Pose<S>& b, const Pose<S>& c_in_b) {
  return {b.rotation * c_in_b.rotation, b.transform(c_in_b.position)};
}

}  // namespace contactscope
