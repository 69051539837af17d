#include <algorithm>
#include <cmath>

#include "continuous/approach_to_plane.h"
#include "continuous/foresee_impact.h"
#include "continuous/safe_fraction.h"
#include "continuous/search_impact.h"

namespace contactscope {
namespace {

/// Bounds the time for which the shapes stay separated along the axis. Without turns a division
/// gives it. Otherwise the bracket runs from the safe time to where the nearest points would reach
/// the target at their present speed. It is narrow enough for a bound close to the root.
struct RootBrackets {
  template <class S>
  std::optional<Closest<S>> foresee(Approach<S>& approach, S radii, const Separation<S>& distance,
                                    ImpactResult<S>& result, ImpactRun<S>* run) const {
    return foresee_impact(approach, radii, distance, result, run);
  }
  template <class S>
  std::nullopt_t foresee(const ApproachToPlane<S>&, const auto&...) const {
    return std::nullopt;
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

/// Distance over the fastest possible approach.
struct DistanceOverSpeed {
  std::nullopt_t foresee(const auto&...) const { return std::nullopt; }
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

/// The only axis that can separate a shape from a plane is the plane's.
template <class S, class Advance>
ImpactResult<S> search(const MovingPlane<S>& a, const MovingShape<S>& b,
                       const ImpactLimits<S>& allowed, ImpactRun<S>* run, const Advance& advance) {
  return search_impact(ApproachToPlane<S>(a, b), S(0), b.radius, a.motion, allowed, run, advance);
}
template <class S, class Advance>
ImpactResult<S> search(const MovingShape<S>& a, const MovingShape<S>& b,
                       const ImpactLimits<S>& allowed, ImpactRun<S>* run, const Advance& advance) {
  return search_impact(Approach<S>(a, b), a.radius, b.radius, a.motion, allowed, run, advance);
}

}  // namespace

template <class S>
ImpactResult<S> time_of_impact(const MovingShape<S>& a, const MovingShape<S>& b,
                               const ImpactLimits<S>& allowed, ImpactRun<S>* run) {
  prefetch_points(a.core);
  prefetch_points(b.core);
  return search(a, b, allowed, run, RootBrackets());
}
template <class S>
ImpactResult<S> time_of_impact(const MovingPlane<S>& a, const MovingShape<S>& b,
                               const ImpactLimits<S>& allowed, ImpactRun<S>* run) {
  return search(a, b, allowed, run, RootBrackets());
}
template <class S>
ImpactResult<S> conservative_advancement(const MovingShape<S>& a, const MovingShape<S>& b,
                                         const ImpactLimits<S>& allowed, ImpactRun<S>* run) {
  return search(a, b, allowed, run, DistanceOverSpeed());
}
template <class S>
ImpactResult<S> conservative_advancement(const MovingPlane<S>& a, const MovingShape<S>& b,
                                         const ImpactLimits<S>& allowed, ImpactRun<S>* run) {
  return search(a, b, allowed, run, DistanceOverSpeed());
}

template <class A, class S>
using Search = ImpactResult<S>(const A&, const MovingShape<S>&, const ImpactLimits<S>&,
                               ImpactRun<S>*);
template Search<MovingShape<float>, float> time_of_impact<float>;
template Search<MovingPlane<float>, float> time_of_impact<float>;
template Search<MovingShape<double>, double> time_of_impact<double>;
template Search<MovingPlane<double>, double> time_of_impact<double>;
template Search<MovingShape<float>, float> conservative_advancement<float>;
template Search<MovingPlane<float>, float> conservative_advancement<float>;
template Search<MovingShape<double>, double> conservative_advancement<double>;
template Search<MovingPlane<double>, double> conservative_advancement<double>;

}  // namespace contactscope
