#pragma once

#include "core/pose.h"

namespace contactscope {

/// Closed ball around a shape, metres. Made empty: a radius of -1. A radius of 0 makes it a point.
template <class S>
struct BoundingSphere {
  using Scalar = S;

  Vec3<S> center = Vec3<S>::Zero();
  S radius = -1;

  /// No point is inside. True for a sphere with NaN too.
  bool empty() const { return !(radius >= 0) || center.hasNaN(); }

  friend bool operator==(const BoundingSphere&, const BoundingSphere&) = default;
};

/// A sphere from its own frame to the parent of `pose`. Its centre is rounded there as the shape's
/// own vertices are.
template <class S>
BoundingSphere<S> placed(const BoundingSphere<S>& sphere, const Pose<S>& pose) {
  return {pose.transform(sphere.center), sphere.radius};
}

}  // namespace contactscope
