#pragma once

#include <algorithm>
#include <cmath>

#include "continuous/impact.h"
#include "query/gjk.h"
#include "query/tolerance.h"

namespace contactscope {

/// A shape as it turns about its pivot, which is the origin here.
template <class S>
class Turning {
 public:
  explicit Turning(const MovingShape<S>& shape)
      : core_(shape.core),
        pivot_(shape.motion.pivot),
        turn_(shape.motion.turn),
        start_(shape.motion.start.rotation) {
    angle_ = turn_.norm();
    if (angle_ > S(0)) axis_ = turn_ / angle_;
    const Vec3<S> local_axis = start_.conjugate() * axis_;
    const auto reach_over = [&](const Vec3<S>& point, S radius) {
      const Vec3<S> arm = point - pivot_;
      reach_ = std::max(reach_, arm.norm() + radius);
      if (angle_ > S(0)) from_axis_ = std::max(from_axis_, arm.cross(local_axis).norm() + radius);
    };
    // A ball about a hull's vertices is quickly found, and costs few steps more than they would.
    if (core_.hull != nullptr) {
      reach_over(core_.hull->centroid, core_.hull->radius);
    } else {
      for (int i = 0; i < core_.count; ++i) reach_over(core_.points[i], 0);
    }
  }

  const SupportSet<S>& core() const { return core_; }
  S reach() const { return reach_; }
  /// Metres a step, of the fastest point.
  S speed() const { return angle_ * from_axis_; }
  /// Of it along `direction`, a unit vector.
  S speed(const Vec3<S>& direction) const {
    return angle_ == S(0) ? S(0) : speed() * direction.cross(axis_).norm();
  }
  /// No point's acceleration along `direction`, a unit vector, is larger; metres a step squared. It
  /// points to the axis, so nothing of it is along the axis.
  S acceleration(const Vec3<S>& direction) const {
    if (angle_ == S(0)) return 0;
    return angle_ * speed() * direction.cross(axis_).norm();
  }

  /// At a time: from the shape's frame.
  Quat<S> rotation(S time) const {
    if (angle_ == S(0)) return start_;
    const S half = S(0.5) * time * angle_;
    Quat<S> by;
    by.w() = std::cos(half);
    by.vec() = std::sin(half) * axis_;
    return by * start_;
  }
  /// How far it reaches along a direction at a time.
  S extent(const Vec3<S>& direction, S time) const {
    const Vec3<S> local = rotation(time).conjugate() * direction;
    const int farthest = support_index(core_, local);
    return local.dot(core_.points[farthest] - pivot_);
  }
  const Vec3<S>& pivot() const { return pivot_; }

 private:
  SupportSet<S> core_;
  Vec3<S> pivot_, turn_;
  Quat<S> start_;
  S angle_ = 0;
  Vec3<S> axis_ = Vec3<S>::UnitX();
  S reach_ = 0, from_axis_ = 0;
};

/// Both shapes as seen from a frame that goes with A's pivot and does not turn.
template <class S>
class Approach {
 public:
  Approach(const MovingShape<S>& a, const MovingShape<S>& b)
      : a_(a),
        b_(b),
        from_a_to_b_(between(a.motion, b.motion)),
        displacement_(b.motion.displacement - a.motion.displacement) {}

  S scale() const {
    return a_.reach() + b_.reach() + from_a_to_b_.norm() + displacement_.norm() +
           a_.pivot().norm() + b_.pivot().norm();
  }
  S largest_motion() const { return displacement_.norm() + a_.speed() + b_.speed(); }

  /// Of the cores along a unit vector, B's side less A's; < 0 where they overlap along it.
  S separation(const Vec3<S>& axis, S time) const {
    return axis.dot(from_a_to_b_ + time * displacement_) -
           (b_.extent(-axis, time) + a_.extent(axis, time));
  }
  S acceleration(const Vec3<S>& axis) const {
    return a_.acceleration(axis) + b_.acceleration(axis);
  }
  /// The separation along `axis` falls by no more, metres a step.
  S closing_speed(const Vec3<S>& axis) const {
    return a_.speed(axis) + b_.speed(axis) - axis.dot(displacement_);
  }
  Quat<S> rotation_of_a(S time) const { return a_.rotation(time); }
  Vec3<S> pivot_of_a() const { return a_.pivot(); }

  GjkResult<S> distance(S time, const Quat<S>& rotation_of_a, const GjkSimplex<S>* warm) const {
    const Quat<S> rotation_of_b = b_.rotation(time);
    const Quat<S> to_a = rotation_of_a.conjugate();
    Pose<S> b_in_a;
    b_in_a.rotation = to_a * rotation_of_b;
    const Vec3<S> b_origin = from_a_to_b_ + time * displacement_ - rotation_of_b * b_.pivot();
    b_in_a.position = to_a * b_origin + a_.pivot();
    return gjk(a_.core(), b_.core(), b_in_a, warm);
  }

 private:
  /// The positions are subtracted first: far from the origin they have digits in common.
  static Vec3<S> between(const Motion<S>& a, const Motion<S>& b) {
    const Vec3<S> origins = b.start.position - a.start.position;
    return origins + (b.start.rotate(b.pivot) - a.start.rotate(a.pivot));
  }

  Turning<S> a_, b_;
  Vec3<S> from_a_to_b_;  // pivots at time 0
  Vec3<S> displacement_;
};

}  // namespace contactscope
