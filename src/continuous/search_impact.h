#pragma once

#include <algorithm>

#include "continuous/approach.h"

namespace contactscope {

/// Two cores that are apart at some time, and what is asked of the time after it.
template <class S>
struct Apart {
  Vec3<S> axis = Vec3<S>::UnitX();  // unit, from A to B, world
  S distance = 0;                   // of the cores, and their separation along the axis
  S target = 0;                     // separation down to which they are apart for certain
  S near = 0;                       // > target: at which it is a hit
};

/// Measures the distance of two moving shapes, lets advance(approach, apart, result, step) move
/// `result.time` to where they cannot yet be nearer than the target, and measures again, until they
/// are near or the step is over. `result.time` of 1 after that is the end: they stay apart.
template <class S, class Advance>
ImpactResult<S> search_impact(const MovingShape<S>& a, const MovingShape<S>& b,
                              const ImpactTolerance<S>& allowed, ImpactRun<S>* run,
                              const Advance& advance) {
  const Approach<S> approach(a, b);
  const S radii = a.radius + b.radius;
  const S rounding = tie_tolerance(approach.scale() + radii);
  const S tolerance =
      std::max({allowed.gap, allowed.of_motion * approach.largest_motion(), S(8) * rounding});
  ImpactResult<S> result;
  const auto ended = [&](ImpactStatus status) {
    result.status = status;
    if (run != nullptr) [[unlikely]]
      run->result = result;
    return result;
  };
  Apart<S> apart;
  GjkResult<S> closest;
  for (result.steps = 1; result.steps <= kMaxImpactSteps; ++result.steps) {
    const Quat<S> rotation_of_a = approach.rotation_of_a(result.time);
    closest = approach.distance(result.time, rotation_of_a,
                                result.steps > 1 ? &closest.simplex : nullptr);
    apart.distance = closest.status == GjkStatus::Separated ? closest.distance : S(0);
    apart.axis = rotation_of_a * closest.normal;
    result.distance = apart.distance - radii;
    if (result.steps == 1) {
      if (result.distance <= S(8) * rounding) return ended(ImpactStatus::Overlapping);
      const S within = std::min(tolerance, result.distance);
      apart.target = radii + S(0.5) * within + rounding;
      apart.near = radii + S(0.75) * within;
    }
    if (apart.distance <= apart.near) {
      result.normal = apart.axis;
      const auto in_world = [&](const Vec3<S>& point) -> Vec3<S> {
        return a.motion.start.transform(a.motion.pivot) + result.time * a.motion.displacement +
               rotation_of_a * (point - approach.pivot_of_a());
      };
      result.on_a = in_world(closest.on_a) + a.radius * apart.axis;
      result.on_b = in_world(closest.on_b) - b.radius * apart.axis;
      return ended(ImpactStatus::Hit);
    }
    ImpactStep<S> step{result.time, result.distance, apart.axis, 1, 0, 0};
    advance(approach, apart, result, step);
    if (run != nullptr) [[unlikely]] {
      step.bracket_separation -= radii;
      step.safe = result.time;
      run->steps.push_back(step);
    }
    if (result.time >= S(1)) {
      result.time = 1;
      return ended(ImpactStatus::Separated);
    }
  }
  result.steps = kMaxImpactSteps;
  return ended(ImpactStatus::OutOfIterations);
}

}  // namespace contactscope
