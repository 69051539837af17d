#pragma once

#include "core/pose.h"

namespace contactscope {

/// Closed ball around a shape, metres. Empty by default: a radius of -1. A radius of 0 is a point.
template <class S>
struct BoundingSphere {
  using Scalar = S;

  Vec3<S> center = Vec3<S>::Zero();
  S radius = -1;

  /// True if no point is inside, and for a sphere with NaN.
  bool empty() const { return !(radius >= 0) || center.hasNaN(); }

  friend bool operator==(const BoundingSphere&, const BoundingSphere&) = default;
};

/// Transforms a sphere from its own frame to the parent of `pose`. Its centre is rounded like the
/// shape's vertices.
template <class S>
BoundingSphere<S> placed(const BoundingSphere<S>& sphere, const Pose<S>& pose) {
  return {pose.transform(sphere.center), sphere.radius};
}

}  // namespace contactscope
