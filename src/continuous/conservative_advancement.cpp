#include <algorithm>

#include "continuous/approach_to_plane.h"
#include "continuous/search_impact.h"

namespace contactscope {
namespace {

struct DistanceOverSpeed {
  /// Makes no prediction.
  template <class Approach, class S>
  std::optional<Closest<S>> foresee(Approach& /*approach*/, S /*radii*/,
                                    const Separation<S>& /*state*/, ImpactResult<S>& /*result*/,
                                    ImpactRun<S>* /*run*/) const {
    return std::nullopt;
  }
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

template ImpactResult<float> conservative_advancement(const MovingShape<float>&,
                                                      const MovingShape<float>&,
                                                      const ImpactLimits<float>&,
                                                      ImpactRun<float>*);
template ImpactResult<double> conservative_advancement(const MovingShape<double>&,
                                                       const MovingShape<double>&,
                                                       const ImpactLimits<double>&,
                                                       ImpactRun<double>*);
template ImpactResult<float> conservative_advancement(const MovingPlane<float>&,
                                                      const MovingShape<float>&,
                                                      const ImpactLimits<float>&,
                                                      ImpactRun<float>*);
template ImpactResult<double> conservative_advancement(const MovingPlane<double>&,
                                                       const MovingShape<double>&,
                                                       const ImpactLimits<double>&,
                                                       ImpactRun<double>*);

}  // namespace contactscope
