#pragma once

#include <algorithm>

#include "continuous/approach.h"

namespace contactscope {

/// A convex shape B and the half-space below a plane, in a frame that moves with the plane's pivot
/// without turning. The only separating axis is the plane's normal, which turns with the plane.
template <class S>
class ApproachToPlane {
 public:
  ApproachToPlane(const MovingPlane<S>& a, const MovingShape<S>& b)
      : b_(b),
        normal_(a.plane.normal),
        offset_(a.plane.distance(a.motion.pivot)),
        start_(a.motion.start.rotation),
        from_a_to_b_(between_pivots(a.motion, b.motion)),
        displacement_(b.motion.displacement - a.motion.displacement) {
    angle_ = a.motion.turn.norm();
    if (angle_ > S(0)) axis_ = a.motion.turn / angle_;
    const Vec3<S> at_end = from_a_to_b_ + displacement_;
    reach_ = std::max(from_a_to_b_.norm(), at_end.norm()) + b_.reach();
  }

  S scale() const { return reach_ + b_.reach() + displacement_.norm() + std::abs(offset_); }
  S largest_motion() const { return displacement_.norm() + b_.speed() + angle_ * reach_; }

  TimeSpan<S> balls_near(S /*radii*/, S /*near*/) const { return {0, 2}; }
  S separation(const Vec3<S>& /*axis*/, S time) const {
    const Vec3<S> normal = normal_at(time);
    return normal.dot(from_a_to_b_ + time * displacement_) + offset_ - b_.extent(-normal, time);
  }
  /// Bound for B's points in the rotating frame of the plane: their own, Coriolis and centrifugal.
  S acceleration(const Vec3<S>& axis) const {
    if (angle_ == S(0)) return b_.acceleration(axis);
    const S speed = displacement_.norm() + b_.speed();
    return b_.acceleration() + S(2) * angle_ * speed + angle_ * angle_ * reach_;
  }
  S closing_speed(const Vec3<S>& axis) const {
    if (angle_ == S(0)) return b_.speed(axis) - axis.dot(displacement_);
    return largest_motion();
  }

  /// Rate at which B's nearest point approaches the plane.
  S closing_speed(const Closest<S>& closest) const {
    const Vec3<S> pivot_of_b = from_a_to_b_ + closest.time * displacement_;
    const Vec3<S> velocity =
        displacement_ + b_.velocity(closest.on_b - pivot_of_b) - angle_ * axis_.cross(closest.on_b);
    return -closest.axis.dot(velocity);
  }

  Closest<S> measure(S time) const {
    const Vec3<S> normal = normal_at(time);
    const Quat<S> rotation = b_.rotation(time);
    const Vec3<S> local = rotation.conjugate() * Vec3<S>(-normal);
    const Vec3<S>& lowest = b_.core().points[support_index(b_.core(), local)];
    Closest<S> closest;
    closest.time = time;
    closest.axis = normal;
    closest.on_b = from_a_to_b_ + time * displacement_ + rotation * (lowest - b_.pivot());
    const S distance = normal.dot(closest.on_b) + offset_;
    closest.on_a = closest.on_b - distance * normal;
    closest.distance = std::max(distance, S(0));
    return closest;
  }

 private:
  Vec3<S> normal_at(S time) const {
    const Quat<S> rotation = angle_ == S(0) ? start_ : turned(start_, axis_, time * angle_);
    return rotation * normal_;
  }

  Turning<S> b_;
  Vec3<S> normal_;  // in the plane's frame
  S offset_;        // of the pivot above the plane
  Quat<S> start_;
  S angle_ = 0;
  Vec3<S> axis_ = Vec3<S>::UnitX();
  Vec3<S> from_a_to_b_, displacement_;
  S reach_ = 0;  // largest distance of B's points from A's pivot, at any time
};

}  // namespace contactscope
