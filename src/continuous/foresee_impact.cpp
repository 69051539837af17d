#include "continuous/foresee_impact.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "continuous/portal_cast.h"
#include "continuous/safe_fraction.h"
#include "query/minkowski_difference.h"

namespace contactscope {
namespace {

template <class S>
CastLimits<S> limits_from(S time, const Separation<S>& gap) {
  return {gap.target, S(0.5) * (gap.near - gap.target), gap.until - time};
}

/// Only when recording. Measures on a copy, so that later results stay the same to the bit.
template <class S>
void record(Approach<S> approach, const ImpactStep<S>& step, ImpactRun<S>& run) {
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
/// The balls approach at a constant speed. At some earlier time, possibly before the step, their
/// gap equals the largest effect of the turns until `time`. After it the bound of safe_fraction()
/// holds; before it the balls alone prove separation.
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
  // Fraction of the time in which the balls are near, where most impacts are. There the first cast
  // sees about the orientations of the impact.
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

}  // namespace

template <class S>
std::optional<Closest<S>> foresee_impact(Approach<S>& approach, S radii, const Separation<S>& gap,
                                         ImpactResult<S>& result, ImpactRun<S>* run) {
  if (radii > S(0)) return std::nullopt;
  const bool turns = approach.a().turns() || approach.b().turns();
  return turns ? cast_turning(approach, gap, result, run)
               : cast_straight(approach, gap, result, run);
}

template decltype(foresee_impact<float>) foresee_impact<float>;
template decltype(foresee_impact<double>) foresee_impact<double>;

}  // namespace contactscope
