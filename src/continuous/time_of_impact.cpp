#include "continuous/time_of_impact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "query/gjk.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

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

/// A lower bound of the separation along a fixed axis between two times at which it is known. A point
/// that is accelerated by no more than k is off the straight line between two of its places by no
/// more than k u (1 - u) width^2 / 2 at the fraction u between them; and the least of many straight
/// lines is nowhere below the straight line between its ends.
///
/// Returns the fraction up to which the bound is above `target`; 1 where it is all the way.
/// `at_begin` > target.
template <class S>
S safe_fraction(S at_begin, S at_end, S acceleration, S width, S target) {
  const S sag = S(0.5) * acceleration * width * width;
  const S c = at_begin - target;        // > 0
  const S b = at_end - at_begin - sag;  // the bound: sag u^2 + b u + c
  if (!(b < S(0))) return 1;
  const S discriminant = b * b - S(4) * sag * c;
  if (discriminant < S(0)) return 1;
  // The smaller root, by the form in which nothing cancels.
  const S root = S(2) * c / (-b + std::sqrt(discriminant));
  return std::min(root, S(1));
}

}  // namespace

template <class S>
ImpactResult<S> time_of_impact(const MovingShape<S>& a, const MovingShape<S>& b,
                               const ImpactTolerance<S>& allowed, ImpactRun<S>* run) {
  const Approach<S> approach(a, b);
  const S radii = a.radius + b.radius;
  const S rounding = tie_tolerance(approach.scale() + radii);
  const S tolerance =
      std::max({allowed.gap, allowed.of_motion * approach.largest_motion(), S(8) * rounding});
  ImpactResult<S> result;
  const auto ended = [&](ImpactStatus status) {
    result.status = status;
    if (run != nullptr) run->result = result;
    return result;
  };
  S target = 0;  // separation of the cores that is not to be passed
  S near = 0;    // at which it is a hit
  GjkResult<S> closest;
  for (result.steps = 1; result.steps <= kMaxImpactSteps; ++result.steps) {
    const Quat<S> rotation_of_a = approach.rotation_of_a(result.time);
    closest = approach.distance(result.time, rotation_of_a,
                                result.steps > 1 ? &closest.simplex : nullptr);
    const S distance = closest.status == GjkStatus::Separated ? closest.distance : S(0);
    result.distance = distance - radii;
    if (result.steps == 1) {
      if (result.distance <= S(8) * rounding) return ended(ImpactStatus::Overlapping);
      const S apart = std::min(tolerance, result.distance);
      target = radii + S(0.5) * apart;
      near = radii + S(0.75) * apart;
    }
    const Vec3<S> axis = rotation_of_a * closest.normal;
    if (distance <= near) {
      result.normal = axis;
      const auto in_world = [&](const Vec3<S>& point) -> Vec3<S> {
        return a.motion.start.transform(a.motion.pivot) + result.time * a.motion.displacement +
               rotation_of_a * (point - approach.pivot_of_a());
      };
      result.on_a = in_world(closest.on_a) + a.radius * axis;
      result.on_b = in_world(closest.on_b) - b.radius * axis;
      return ended(ImpactStatus::Hit);
    }

    // Along this axis they stay apart for a while: until when, at the least? The bracket from the
    // safe time to where the separation is below the target shrinks until it is no longer worth it.
    const S acceleration = approach.acceleration(axis);
    S separation = distance, end = 1;
    const S began = result.time;
    for (int tries = 0; tries < 4; ++tries) {
      const S at_end = approach.separation(axis, end);
      ++result.bounds;
      const S width = end - result.time;
      const S fraction = safe_fraction(separation, at_end, acceleration, width, target + rounding);
      result.time = fraction == S(1) ? end : result.time + fraction * width;
      if (run != nullptr) [[unlikely]] {
        if (tries == 0)
          run->steps.push_back({began, distance - radii, axis, end, at_end - radii, 0});
        run->steps.back().safe = result.time;
        run->steps.back().bracket_end = end;
        run->steps.back().bracket_separation = at_end - radii;
      }
      if (fraction == S(1)) {
        if (end == S(1)) {
          result.time = 1;
          return ended(ImpactStatus::Separated);
        }
        break;
      }
      if (acceleration == S(0)) break;  // the line was exact
      separation = approach.separation(axis, result.time);
      ++result.bounds;
      if (separation <= near) break;
      // Where the straight line between both ends meets the target, or half of the way.
      const S left = end - result.time;
      const S line = at_end < target ? (separation - target) / (separation - at_end) : S(0.5);
      end = result.time + left * std::min(line, S(0.9));
    }
  }
  result.steps = kMaxImpactSteps;
  return ended(ImpactStatus::OutOfIterations);
}

template decltype(time_of_impact<float>) time_of_impact<float>;
template decltype(time_of_impact<double>) time_of_impact<double>;

}  // namespace contactscope
