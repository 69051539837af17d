#pragma once

#include <algorithm>
#include <optional>

#include "continuous/approach.h"

namespace contactscope {

/// Two cores that are separated at some time, and the limits of the search after it.
template <class S>
struct Separation {
  Vec3<S> axis = Vec3<S>::UnitX();  // unit, from A to B, world
  S separation = 0;                 // of the cores along the axis, metres
  S speed = 0;                      // closing speed of the nearest points along the axis, per step
  S target = 0;                     // smallest separation that is safe
  S near = 0;                       // > target: separation of a hit
  S until = 1;                      // end of the search
};

/// Measures the distance of two moving shapes, lets advance(approach, state, result, step) move
/// `result.time` to a later safe time, and measures again, until they are near or the step is over.
/// They stay separated if `result.time` reaches allowed.until. `approach` measures in a frame that
/// moves with the pivot of `of_a`.
template <class S, class Approach, class Advance>
ImpactResult<S> search_impact(Approach&& approach, S radius_a, S radius_b, const Sweep<S>& of_a,
                              const ImpactLimits<S>& allowed, ImpactRun<S>* run,
                              const Advance& advance) {
  const S radii = radius_a + radius_b;
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
  Separation<S> state;
  state.until = allowed.until;
  const TimeSpan<S> balls = approach.balls_near(radii, tolerance);
  const S begin = balls.begin;
  result.time = begin;
  state.until = std::min(allowed.until, balls.end);
  const auto separated = [&] {
    result.time = allowed.until;
    return ended(ImpactStatus::Separated);
  };
  // Shapes nearer than the tolerance at the start get their distance as the tolerance.
  const auto come_within = [&](S within) {
    state.target = radii + S(0.5) * within + rounding;
    state.near = radii + S(0.75) * within;
  };
  std::optional<Closest<S>> foreseen;
  if (begin > S(0)) {
    if (begin >= state.until) return separated();
    come_within(tolerance);
    foreseen = advance.foresee(approach, radii, state, result, run);
    if (result.time >= state.until) return separated();
  }
  for (result.steps = 1; result.steps <= kMaxImpactSteps; ++result.steps) {
    const Closest<S> closest = foreseen ? *foreseen : approach.measure(result.time);
    foreseen.reset();
    state.separation = closest.distance;
    state.axis = closest.axis;
    state.speed = approach.closing_speed(closest);
    result.distance = closest.distance - radii;
    if (result.steps == 1 && begin == S(0)) {
      if (result.distance <= S(8) * rounding) {
        // Rounding of the motion exceeds the distance: the outcome is unknown.
        const S at_rest = approach.scale() + radii - approach.largest_motion();
        const bool separated_at_rest =
            result.distance > S(8) * tie_tolerance(std::max(at_rest, S(0)));
        result.normal = closest.axis;
        return ended(separated_at_rest ? ImpactStatus::OutOfIterations : ImpactStatus::Overlapping);
      }
      come_within(std::min(tolerance, result.distance));
    }
    if (closest.distance <= state.near) {
      const Vec3<S> origin = of_a.start.transform(of_a.pivot) + result.time * of_a.displacement;
      result.normal = closest.axis;
      result.on_a = origin + closest.on_a + radius_a * closest.axis;
      result.on_b = origin + closest.on_b - radius_b * closest.axis;
      return ended(ImpactStatus::Hit);
    }
    if (result.steps == 1 && begin == S(0)) {
      foreseen = advance.foresee(approach, radii, state, result, run);
      if (result.time >= state.until) return separated();
      if (result.time > begin) continue;
    }
    ImpactStep<S> step{result.time, result.distance, state.axis, state.until, 0, 0};
    advance(approach, state, result, step);
    if (run != nullptr) [[unlikely]] {
      step.bracket_separation -= radii;
      step.safe = result.time;
      run->steps.push_back(step);
    }
    if (result.time >= state.until) return separated();
  }
  result.steps = kMaxImpactSteps;
  result.normal = state.axis;
  return ended(ImpactStatus::OutOfIterations);
}

}  // namespace contactscope
