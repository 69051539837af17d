#pragma once

#include "core/pose.h"
#include "geometry/aabb.h"

namespace contactscope {

/// Oriented bounding box, closed, metres: center + s0 axes[0] + s1 axes[1] + s2 axes[2] with |sk|
/// <= half_extents[k]. Empty by default: half extents of -1. A half extent may be 0.
///
/// The axes are the columns of `axes`, orthonormal to 8 epsilon: no entry of A^T A - I is larger. A
/// rotation matrix from a unit quaternion satisfies this.
template <class S> struct Obb {
  using Scalar = S;

  Vec3<S> center = Vec3<S>::Zero();
  Mat3<S> axes = Mat3<S>::Identity();
  Vec3<S> half_extents = Vec3<S>::Constant(-1);

  /// True if no point is inside, and for a box with NaN.
  bool empty() const {
    return !(half_extents.x() >= 0 && half_extents.y() >= 0 && half_extents.z() >= 0) ||
           center.hasNaN() || axes.hasNaN();
  }
  /// Cubic metres; 0 for an empty box.
  S volume() const { return empty() ? S(0) : S(8) * half_extents.prod(); }

  template <class T> Obb<T> cast() const {
    return {center.template cast<T>(), axes.template cast<T>(), half_extents.template cast<T>()};
  }

  friend bool operator==(const Obb&, const Obb&) = default;
};

/// To the parent of `pose`; centre and axes are rounded like the shape's vertices.
template <class S> Obb<S> placed(const Obb<S>& box, const Pose<S>& pose) {
  const Mat3<S> rotation = pose.rotation.toRotationMatrix();
  Obb<S> result = box;
  result.center = pose.transform(box.center);
  result.axes = rotation * box.axes;
  return result;
}

/// Closed ball around a shape, metres. Empty by default: a radius of -1. A radius of 0 is a point.
template <class S> struct BoundingSphere {
  using Scalar = S;

  Vec3<S> center = Vec3<S>::Zero();
  S radius = -1;

  /// True if no point is inside, and for a sphere with NaN.
  bool empty() const { return !(radius >= 0) || center.hasNaN(); }
  friend bool operator==(const BoundingSphere&, const BoundingSphere&) = default;
};

/// To the parent of `pose`; the centre is rounded like the shape's vertices.
template <class S> BoundingSphere<S> placed(const BoundingSphere<S>& sphere, const Pose<S>& pose) {
  return {pose.transform(sphere.center), sphere.radius};
}

}  // namespace contactscope
