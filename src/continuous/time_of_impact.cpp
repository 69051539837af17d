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

/// Along the axis the shapes stay apart for a while: until when, at the least? The bracket from the
/// safe time to where the separation is below the target shrinks until it is no longer worth it.
struct RootBrackets {
  template <class Approach, class S>
  void operator()(const Approach& approach, const Apart<S>& apart, ImpactResult<S>& result,
                  ImpactStep<S>& step) const {
    constexpr int kMostBrackets = 4;
    const S acceleration = approach.acceleration(apart.axis);
    S separation = apart.distance, end = apart.until;
    for (int tries = 0; tries < kMostBrackets; ++tries) {
      const S at_end = approach.separation(apart.axis, end);
      ++result.bounds;
      const S width = end - result.time;
      const S fraction = safe_fraction(separation, at_end, acceleration, width, apart.target);
      result.time = fraction == S(1) ? end : result.time + fraction * width;
      step.bracket_end = end;
      step.bracket_separation = at_end;
      if (fraction == S(1) || acceleration == S(0)) return;  // all of it is safe; or it was exact
      separation = approach.separation(apart.axis, result.time);
      ++result.bounds;
      if (separation <= apart.near) return;
      // Where the straight line between both ends meets the target, or half of the way.
      const S left = end - result.time;
      const S line =
          at_end < apart.target ? (separation - apart.target) / (separation - at_end) : S(0.5);
      end = result.time + left * std::min(line, S(0.9));
    }
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
