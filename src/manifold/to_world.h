#pragma once

#include "core/plane.h"
#include "core/pose.h"

namespace contactscope {

/// From A's frame, where the pair is worked on, to the world, where results are given.
template <class S>
class ToWorld {
 public:
  explicit ToWorld(const Pose<S>& a)
      : rotation_(a.rotation.toRotationMatrix()), position_(a.position) {}

  Vec3<S> point(const Vec3<S>& in_a) const { return rotation_ * in_a + position_; }
  Vec3<S> direction(const Vec3<S>& in_a) const { return rotation_ * in_a; }
  Plane<S> plane(const Plane<S>& in_a) const {
    const Vec3<S> normal = direction(in_a.normal);
    return {normal, in_a.offset + normal.dot(position_)};
  }

 private:
  Mat3<S> rotation_;
  Vec3<S> position_;
};

}  // namespace contactscope
