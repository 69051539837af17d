#include <algorithm>
#include <cmath>

#include "continuous/approach_to_plane.h"
#include "continuous/search_impact.h"

namespace contactscope {
namespace {

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

/// Along the axis the shapes stay apart for a while: until when, at the least? What does not turn says
/// so by a division. Else a bracket from the safe time to where the nearest points would meet the
/// target, at the speed that they have now, is narrow enough for its bound to be near the root.
struct RootBrackets {
  template <class Approach, class S>
  void operator()(const Approach& approach, const Apart<S>& apart, ImpactResult<S>& result,
                  ImpactStep<S>& step) const {
    const S acceleration = approach.acceleration(apart.axis);
    const S gap = apart.separation - apart.target, left = apart.until - result.time;
    const S fastest = approach.closing_speed(apart.axis);
    step.bracket_end = apart.until;
    step.bracket_separation = apart.separation - fastest * left;
    if (gap >= fastest * left) {
      result.time = apart.until;
      return;
    }
    const S sure = gap / fastest;
    S width = sure;
    if (acceleration > S(0)) {
      width = apart.speed * left > gap ? std::max(gap / apart.speed, sure) : left;
      const S at_end = approach.separation(apart.axis, result.time + width);
      ++result.bounds;
      step.bracket_end = result.time + width;
      step.bracket_separation = at_end;
      width *= safe_fraction(apart.separation, at_end, acceleration, width, apart.target);
    }
    result.time += std::max(width, sure);
  }
};

}  // namespace

template <class S>
ImpactResult<S> time_of_impact(const MovingShape<S>& a, const MovingShape<S>& b,
                               const ImpactLimits<S>& allowed, ImpactRun<S>* run) {
  return search_impact(Approach<S>(a, b), a.radius, b.radius, a.motion, allowed, run,
                       RootBrackets());
}

template <class S>
ImpactResult<S> time_of_impact(const MovingPlane<S>& a, const MovingShape<S>& b,
                               const ImpactLimits<S>& allowed, ImpactRun<S>* run) {
  return search_impact(ApproachToPlane<S>(a, b), S(0), b.radius, a.motion, allowed, run,
                       RootBrackets());
}

template ImpactResult<float> time_of_impact(const MovingShape<float>&, const MovingShape<float>&,
                                            const ImpactLimits<float>&, ImpactRun<float>*);
template ImpactResult<double> time_of_impact(const MovingShape<double>&, const MovingShape<double>&,
                                             const ImpactLimits<double>&, ImpactRun<double>*);
template ImpactResult<float> time_of_impact(const MovingPlane<float>&, const MovingShape<float>&,
                                            const ImpactLimits<float>&, ImpactRun<float>*);
template ImpactResult<double> time_of_impact(const MovingPlane<double>&, const MovingShape<double>&,
                                             const ImpactLimits<double>&, ImpactRun<double>*);

}  // namespace contactscope
