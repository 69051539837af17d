#include "continuous/portal_cast.h"
#include "query/minkowski_difference.h"

namespace contactscope {
namespace {

/// Two cores that are separated at some time, and the limits of the search after it.
template <class S> struct Separation {
  Vec3<S> axis = Vec3<S>::UnitX();  // unit, from A to B, world
  S separation = 0;                 // of the cores along the axis, metres
  S speed = 0;                      // closing speed of the nearest points along the axis, per step
  S target = 0;                     // smallest separation that is safe
  S near = 0;                       // > target: separation of a hit
  S until = 1;                      // end of the search
};

/// Measures the distance of two moving shapes, lets advance(approach, state, result, step) move
/// `result.time` to a later safe time, until they are near or the step is over, or allowed.until is
/// reached. `approach` measures in a frame that moves with the pivot of `of_a`.
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

/// Lower bound of the separation along a fixed axis between two times at which it is known. A point
/// with an acceleration up to k is off the straight line between its ends by at most k u (1 - u)
/// width^2 / 2 at the fraction u. A minimum of lines is never below its chord.
///
/// Returns the fraction up to which the bound is above `target` (< `at_begin`); 1 if it always is.
template <class S> S safe_fraction(S at_begin, S at_end, S acceleration, S width, S target) {
  const S sag = S(0.5) * acceleration * width * width;
  const S c = at_begin - target;        // > 0
  const S b = at_end - at_begin - sag;  // the bound: sag u^2 + b u + c
  if (!(b < S(0))) return 1;
  const S discriminant = b * b - S(4) * sag * c;
  if (discriminant < S(0)) return 1;
  // The smaller root, in the form without cancellation.
  const S root = S(2) * c / (-b + std::sqrt(discriminant));
  return std::min(root, S(1));
}

template <class S> CastLimits<S> limits_from(S time, const Separation<S>& gap) {
  return {gap.target, S(0.5) * (gap.near - gap.target), gap.until - time};
}

/// Only when recording. Measures on a copy, so that later results stay the same to the bit.
template <class S> void record(Approach<S> approach, const ImpactStep<S>& step, ImpactRun<S>& run) {
  run.steps.push_back(step);
  run.steps.back().distance = approach.measure(step.time).distance;
}

template <class S>
void record_planes(const Approach<S>& approach, const std::vector<SupportPlane<S>>& planes, S begin,
                   S until, ImpactRun<S>& run) {
  S from = begin;
  for (const SupportPlane<S>& plane : planes) {
    const Vec3<S> axis = -plane.normal;
    const S safe = std::min(begin + plane.time, until);
    const S at_end = plane.separation + axis.dot(approach.displacement()) * (safe - begin);
    record(approach, {from, 0, axis, safe, at_end, safe}, run);
    from = safe;
  }
}

/// Closest points of a cast's portal at `time` if a hit; else GJK will start from the portal.
template <class S>
std::optional<Closest<S>> hit_at(S time, S time_of_cast, const PortalCast<S>& cast,
                                 const Separation<S>& gap, Approach<S>& approach) {
  Closest<S> closest = cast.closest(time_of_cast);
  closest.time = time;
  if (closest.distance <= gap.near) return closest;
  approach.measure_from(cast.portal());
  return std::nullopt;
}

template <class S>
std::optional<Closest<S>> cast_straight(Approach<S>& approach, const Separation<S>& gap,
                                        ImpactResult<S>& result, ImpactRun<S>* run) {
  const S begin = result.time;
  PortalCast<S> cast(approach.a(), approach.b(), approach.scale());
  cast.place(begin, approach.between_pivots_at(begin), approach.displacement());
  std::vector<SupportPlane<S>> planes;
  const CastStatus status = cast.cast(limits_from(begin, gap), run != nullptr ? &planes : nullptr);
  result.bounds += cast.supports();
  result.time = status == CastStatus::Separated ? gap.until : begin + cast.safe_time();
  if (run != nullptr) [[unlikely]]
    record_planes(approach, planes, begin, gap.until, *run);
  if (status != CastStatus::Hit) return std::nullopt;
  return hit_at(result.time, cast.safe_time(), cast, gap, approach);
}

/// Whether balls about the pivots prove separation along an axis until `time`, if separated then.
/// At some earlier time, possibly before the step, their gap equals the largest effect of the
/// turns. After it the bound of safe_fraction() holds; before it the balls alone prove separation.
template <class S>
bool balls_prove(const Approach<S>& approach, const Vec3<S>& axis, S time, S target) {
  const S reach = approach.a().reach() + approach.b().reach();
  const S overlap = (reach + target) - axis.dot(approach.between_pivots_at(time));
  const S speed = -axis.dot(approach.displacement());
  if (!(speed > S(0))) return false;
  if (overlap <= S(0)) return true;
  // speed w - overlap = acceleration w^2 / 2, the smaller root, and a little more for its rounding.
  const S acceleration = approach.acceleration(axis);
  const S squared = speed * speed - S(2) * acceleration * overlap;
  if (!(squared >= S(0))) return false;
  const S width = S(1.01) * (S(2) * overlap / (speed + std::sqrt(squared)));
  return speed * width - overlap >= S(0.5) * acceleration * width * width;
}

template <class S>
std::optional<Closest<S>> cast_turning(Approach<S>& approach, const Separation<S>& gap,
                                       ImpactResult<S>& result, ImpactRun<S>* run) {
  // Each cast about squares the error. Shapes that need more also spin too fast for the bound.
  constexpr int kMaxCasts = 4;
  // Fraction of the time in which the balls are near, to begin at: there most impacts are.
  constexpr S kFirstGuess = S(0.15);
  const S begin = result.time;
  const S aim = S(0.5) * (gap.target + gap.near);
  PortalCast<S> cast(approach.a(), approach.b(), approach.scale());
  Vec3<S> velocity = approach.displacement();
  S time = begin + kFirstGuess * (gap.until - begin), at_end = 0;
  if (gap.speed > S(0)) time = std::min(time, begin + gap.separation / gap.speed);
  CastStatus status = CastStatus::Hit;
  bool is_met = false;
  for (int i = 0; i < kMaxCasts && time < gap.until; ++i) {
    cast.place(time, approach.between_pivots_at(time), velocity);
    const CastLimits<S> limits = limits_from(time, gap);
    status = i == 0 ? cast.cast(limits) : cast.cast_again(limits);
    if (status == CastStatus::Separated) time = gap.until;
    if (status != CastStatus::Hit) break;
    at_end = cast.plane().separation;
    is_met = at_end > gap.target && at_end < gap.near;
    if (is_met) break;
    const GjkSimplex<S> portal = cast.portal();
    velocity = approach.displacement() + approach.b().velocity(weighted(portal, &GjkVertex<S>::b)) -
               approach.a().velocity(weighted(portal, &GjkVertex<S>::a));
    const S closing = cast.plane().normal.dot(velocity);
    if (!(closing > S(0))) break;
    time = std::clamp(time + (at_end - aim) / closing, begin, gap.until);
  }
  result.bounds += cast.supports();

  const S width = time - begin;
  if (!(width > S(0) && cast.supports() > 0)) return std::nullopt;
  const Vec3<S> axis = -cast.plane().normal;
  if (!is_met) {
    at_end = approach.separation(axis, time);
    ++result.bounds;
  }
  S fraction = 1;
  if (!(at_end > gap.target && balls_prove(approach, axis, time, gap.target))) {
    const S at_begin = approach.separation(axis, begin);
    ++result.bounds;
    if (!(at_begin > gap.target)) return std::nullopt;
    fraction = safe_fraction(at_begin, at_end, approach.acceleration(axis), width, gap.target);
  }
  const bool is_safe = fraction == S(1);
  result.time = is_safe ? time : begin + fraction * width;
  if (run != nullptr) [[unlikely]]
    record(approach, {begin, 0, axis, time, at_end, result.time}, *run);
  if (is_met && is_safe) return hit_at(time, S(0), cast, gap, approach);
  if (status == CastStatus::Hit) approach.measure_from(cast.portal());
  return std::nullopt;
}

/// Advances `result.time`, at which the separation exceeds the target, to a later safe time: near
/// the first impact, or the end of the search if there is none. Returns the closest points there if
/// they are known without a measurement. `radii`: sum of both surfaces' radii, metres.
///
/// Polyhedra that do not turn are cast against each other (portal_cast.h). If one turns, repeated
/// casts with the velocities of the approaching points converge like Newton's method. Along the
/// axis found, balls about the pivots usually prove that there is no earlier contact; otherwise
/// safe_fraction() bounds the safe part, for two more support points. Round shapes do not advance:
/// their difference has no faces, so a portal would shrink to a point, and GJK is cheaper.
template <class S>
std::optional<Closest<S>> foresee_impact(Approach<S>& approach, S radii, const Separation<S>& gap,
                                         ImpactResult<S>& result, ImpactRun<S>* run) {
  if (radii > S(0)) return std::nullopt;
  const bool turns = approach.a().turns() || approach.b().turns();
  return turns ? cast_turning(approach, gap, result, run)
               : cast_straight(approach, gap, result, run);
}

struct NoForesight {
  template <class Approach, class S>
  std::optional<Closest<S>> foresee(Approach& /*approach*/, S /*radii*/,
                                    const Separation<S>& /*state*/, ImpactResult<S>& /*result*/,
                                    ImpactRun<S>* /*run*/) const {
    return std::nullopt;
  }
};

/// Bounds the time for which the shapes stay separated along the axis. Without turns a division
/// gives it. Otherwise the bracket runs from the safe time to where the nearest points would reach
/// the target at their present speed. It is narrow enough for a bound close to the root.
struct RootBrackets : NoForesight {
  using NoForesight::foresee;
  template <class S>
  std::optional<Closest<S>> foresee(Approach<S>& approach, S radii, const Separation<S>& distance,
                                    ImpactResult<S>& result, ImpactRun<S>* run) const {
    return foresee_impact(approach, radii, distance, result, run);
  }
  template <class Approach, class S>
  void operator()(const Approach& approach, const Separation<S>& distance, ImpactResult<S>& result,
                  ImpactStep<S>& step) const {
    const S acceleration = approach.acceleration(distance.axis);
    const S gap = distance.separation - distance.target, left = distance.until - result.time;
    const S fastest = approach.closing_speed(distance.axis);
    step.bracket_end = distance.until;
    step.bracket_separation = distance.separation - fastest * left;
    if (gap >= fastest * left) {
      result.time = distance.until;
      return;
    }
    const S sure = gap / fastest;
    S width = sure;
    if (acceleration > S(0)) {
      width = distance.speed * left > gap ? std::max(gap / distance.speed, sure) : left;
      const S at_end = approach.separation(distance.axis, result.time + width);
      ++result.bounds;
      step.bracket_end = result.time + width;
      step.bracket_separation = at_end;
      width *= safe_fraction(distance.separation, at_end, acceleration, width, distance.target);
    }
    result.time += std::max(width, sure);
  }
};

struct DistanceOverSpeed : NoForesight {
  template <class Approach, class S>
  void operator()(const Approach& approach, const Separation<S>& spacing, ImpactResult<S>& result,
                  ImpactStep<S>& step) const {
    const S speed = approach.closing_speed(spacing.axis);
    const S left = spacing.until - result.time;
    ++result.bounds;
    const S gap = spacing.separation - spacing.target;
    result.time = gap >= speed * left ? spacing.until : result.time + gap / speed;
    step.bracket_end =
        step.distance >= speed * left ? spacing.until : step.time + step.distance / speed;
    step.bracket_separation = spacing.separation - speed * (step.bracket_end - step.time);
  }
};

}  // namespace

template <class S>
ImpactResult<S> time_of_impact(const MovingShape<S>& a, const MovingShape<S>& b,
                               const ImpactLimits<S>& allowed, ImpactRun<S>* run) {
  prefetch_points(a.core);
  prefetch_points(b.core);
  return search_impact(Approach<S>(a, b), a.radius, b.radius, a.motion, allowed, run,
                       RootBrackets());
}

template <class S>
ImpactResult<S> time_of_impact(const MovingPlane<S>& a, const MovingShape<S>& b,
                               const ImpactLimits<S>& allowed, ImpactRun<S>* run) {
  return search_impact(ApproachToPlane<S>(a, b), S(0), b.radius, a.motion, allowed, run,
                       RootBrackets());
}

template <class S>
ImpactResult<S> conservative_advancement(const MovingShape<S>& a, const MovingShape<S>& b,
                                         const ImpactLimits<S>& allowed, ImpactRun<S>* run) {
  return search_impact(Approach<S>(a, b), a.radius, b.radius, a.motion, allowed, run,
                       DistanceOverSpeed());
}

template <class S>
ImpactResult<S> conservative_advancement(const MovingPlane<S>& a, const MovingShape<S>& b,
                                         const ImpactLimits<S>& allowed, ImpactRun<S>* run) {
  return search_impact(ApproachToPlane<S>(a, b), S(0), b.radius, a.motion, allowed, run,
                       DistanceOverSpeed());
}

template <class A, class S>
using FindImpact = ImpactResult<S>(const A&, const MovingShape<S>&, const ImpactLimits<S>&,
                                   ImpactRun<S>*);
template FindImpact<MovingShape<float>, float> time_of_impact;
template FindImpact<MovingShape<float>, float> conservative_advancement;
template FindImpact<MovingShape<double>, double> time_of_impact;
template FindImpact<MovingShape<double>, double> conservative_advancement;
template FindImpact<MovingPlane<float>, float> time_of_impact;
template FindImpact<MovingPlane<float>, float> conservative_advancement;
template FindImpact<MovingPlane<double>, double> time_of_impact;
template FindImpact<MovingPlane<double>, double> conservative_advancement;

}  // namespace contactscope
