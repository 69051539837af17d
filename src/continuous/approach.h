#pragma once

#include "continuous/impact.h"
#include "query/gjk.h"
#include "query/tolerance.h"

namespace contactscope {

/// A shape that turns about its pivot, which is the origin here.
template <class S> class Turning {
 public:
  explicit Turning(const MovingShape<S>& shape)
      : core_(shape.core), pivot_(shape.motion.pivot), start_(shape.motion.start.rotation) {
    const Vec3<S>& turn = shape.motion.turn;
    angle_ = turn.norm();
    if (angle_ > S(0)) axis_ = turn / angle_;
    const Vec3<S> local_axis = start_.conjugate() * axis_;
    const auto reach_over = [&](const Vec3<S>& point, S radius) {
      const Vec3<S> arm = point - pivot_;
      reach_ = std::max(reach_, arm.norm() + radius);
      if (angle_ > S(0)) from_axis_ = std::max(from_axis_, arm.cross(local_axis).norm() + radius);
    };
    // A hull's bounding ball is cheap, and costs few more steps than the vertices would.
    if (core_.hull != nullptr)
      reach_over(core_.hull->centroid, core_.hull->radius);
    else
      for (int i = 0; i < core_.count; ++i) reach_over(core_.points[i], 0);
  }

  const SupportSet<S>& core() const { return core_; }
  bool turns() const { return angle_ > S(0); }
  S reach() const { return reach_; }
  /// Speed of the fastest point, metres per step.
  S speed() const { return angle_ * from_axis_; }
  /// Largest component along `direction`, a unit vector.
  S speed(const Vec3<S>& direction) const {
    return angle_ == S(0) ? S(0) : speed() * direction.cross(axis_).norm();
  }
  /// Bound of any point's acceleration along `direction`, a unit vector, metres per step squared.
  /// The acceleration points to the axis, so it has no component along it.
  S acceleration(const Vec3<S>& direction) const { return angle_ * speed(direction); }
  /// Bound along any direction.
  S acceleration() const { return angle_ * speed(); }

  /// From the shape's frame, at a time.
  Quat<S> rotation(S time) const {
    return angle_ == S(0) ? start_ : turned(start_, axis_, time * angle_);
  }
  S extent(const Vec3<S>& direction, S time) const {
    const Vec3<S> local = rotation(time).conjugate() * direction;
    const int farthest = support_index(core_, local);
    return local.dot(core_.points[farthest] - pivot_);
  }
  const Vec3<S>& pivot() const { return pivot_; }
  /// Velocity of a point at `arm` from the pivot, metres per step.
  Vec3<S> velocity(const Vec3<S>& arm) const { return angle_ * axis_.cross(arm); }

 private:
  SupportSet<S> core_;
  Vec3<S> pivot_;
  Quat<S> start_;
  S angle_ = 0;
  Vec3<S> axis_ = Vec3<S>::UnitX();
  S reach_ = 0, from_axis_ = 0;
};

/// From A's pivot to B's at time 0. Subtracts positions first, which share digits far away.
template <class S> Vec3<S> between_pivots(const Sweep<S>& a, const Sweep<S>& b) {
  const Vec3<S> origins = b.start.position - a.start.position;
  return origins + (b.start.rotate(b.pivot) - a.start.rotate(a.pivot));
}

/// Closest points of both cores at a time, in a frame that moves with A's pivot without turning.
template <class S> struct Closest {
  S time = 0;
  S distance = 0;                   // metres; 0 when they touch or overlap
  Vec3<S> axis = Vec3<S>::UnitX();  // unit, from A to B
  Vec3<S> on_a, on_b;               // valid only when separated
};

template <class S> struct TimeSpan { S begin, end; };

/// Two convex shapes in a frame that moves with A's pivot without turning.
template <class S> class Approach {
 public:
  Approach(const MovingShape<S>& a, const MovingShape<S>& b)
      : a_(a),
        b_(b),
        from_a_to_b_(between_pivots(a.motion, b.motion)),
        displacement_(b.motion.displacement - a.motion.displacement) {}

  S scale() const {
    return a_.reach() + b_.reach() + from_a_to_b_.norm() + displacement_.norm() +
           a_.pivot().norm() + b_.pivot().norm();
  }
  S largest_motion() const { return displacement_.norm() + a_.speed() + b_.speed(); }
  const Turning<S>& a() const { return a_; }
  const Turning<S>& b() const { return b_; }
  /// From A's pivot to B's at a time, and its change in the step.
  Vec3<S> between_pivots_at(S time) const { return from_a_to_b_ + time * displacement_; }
  const Vec3<S>& displacement() const { return displacement_; }

  /// Time span in which bounding balls about the pivots can be within `near`, metres. The surfaces
  /// are `radii` outside the cores. Begins at 0 if near at the start, after 1 if never near.
  TimeSpan<S> balls_near(S radii, S near) const {
    constexpr TimeSpan<S> kNever = {2, 2};
    const S rounding = tie_tolerance(scale() + radii);
    const S reach = a_.reach() + b_.reach() + radii + near + S(4) * rounding;
    const S squared = displacement_.squaredNorm();
    const bool near_at_start = from_a_to_b_.norm() <= reach;
    if (!(squared > S(0))) return near_at_start ? TimeSpan<S>{0, 2} : kNever;
    // The component across the displacement, orthogonalised twice to remove its rounding.
    const S nearest = -from_a_to_b_.dot(displacement_) / squared;
    if (nearest < S(0) && !near_at_start) return kNever;
    Vec3<S> across = from_a_to_b_ + nearest * displacement_;
    across -= across.dot(displacement_) / squared * displacement_;
    const S inside = std::max(reach * reach - across.squaredNorm(), S(0));
    if (inside == S(0) && !near_at_start) return kNever;
    const S half = (std::sqrt(inside) + S(4) * rounding) / std::sqrt(squared);
    return {near_at_start ? S(0) : std::max(nearest - half, S(0)), std::max(nearest + half, S(0))};
  }

  /// Separation of the cores along a unit vector, B's side minus A's; negative: overlap.
  S separation(const Vec3<S>& axis, S time) const {
    return axis.dot(from_a_to_b_ + time * displacement_) -
           (b_.extent(-axis, time) + a_.extent(axis, time));
  }
  S acceleration(const Vec3<S>& axis) const {
    return a_.acceleration(axis) + b_.acceleration(axis);
  }
  /// Upper bound of the rate at which the separation along `axis` falls, metres per step.
  S closing_speed(const Vec3<S>& axis) const {
    return a_.speed(axis) + b_.speed(axis) - axis.dot(displacement_);
  }

  /// Rate at which the nearest points now approach along their axis, metres per step.
  S closing_speed(const Closest<S>& closest) const {
    const Vec3<S> pivot_of_b = from_a_to_b_ + closest.time * displacement_;
    const Vec3<S> velocity =
        displacement_ + b_.velocity(closest.on_b - pivot_of_b) - a_.velocity(closest.on_a);
    return -closest.axis.dot(velocity);
  }

  /// Starts GJK from the simplex of the previous call, or from a given one.
  Closest<S> measure(S time) {
    const Quat<S> rotation_of_a = a_.rotation(time), rotation_of_b = b_.rotation(time);
    const Quat<S> to_a = rotation_of_a.conjugate();
    const Vec3<S> b_origin = from_a_to_b_ + time * displacement_ - rotation_of_b * b_.pivot();
    Pose<S> b_in_a;
    b_in_a.rotation = to_a * rotation_of_b;
    b_in_a.position = to_a * b_origin + a_.pivot();
    gjk_ =
        gjk(a_.core(), b_.core(), b_in_a, gjk_.simplex.vertices.empty() ? nullptr : &gjk_.simplex);
    return {time, gjk_.status == GjkStatus::Separated ? gjk_.distance : S(0),
            rotation_of_a * gjk_.normal, rotation_of_a * (gjk_.on_a - a_.pivot()),
            rotation_of_a * (gjk_.on_b - a_.pivot())};
  }
  void measure_from(const GjkSimplex<S>& simplex) { gjk_.simplex = simplex; }

 private:
  Turning<S> a_, b_;
  Vec3<S> from_a_to_b_;  // pivots at time 0
  Vec3<S> displacement_;
  GjkResult<S> gjk_;  // of the last measurement
};

/// A convex shape B and the half-space below a plane, in a frame that moves with the plane's pivot
/// without turning. The only separating axis is the plane's normal, which turns with the plane.
template <class S> class ApproachToPlane {
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
