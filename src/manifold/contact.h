#pragma once

#include "core/manifold.h"
#include "core/pose.h"

namespace contactscope {

/// Contact of two convex shapes, in A's frame, before reduction. Empty above the margin.
template <class S> struct Contact {
  AxisKind axis = AxisKind::FaceA;
  ContactType type = ContactType::FaceFace;
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from A to B
  S scale = S(0);  // metres: no coordinate behind the points is larger; see ReduceOptions
  StaticVector<ContactPoint<S>, kMaxManifoldPoints> points;  // as in Manifold, but in A's frame

  /// Separation of the deepest point, metres; +infinity without points.
  S deepest() const {
    S least = std::numeric_limits<S>::infinity();
    for (const ContactPoint<S>& point : points) least = std::min(least, point.separation);
    return least;
  }
};

/// From A's frame, where pairs are computed, to the world, where results are given.
template <class S> class ToWorld {
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
