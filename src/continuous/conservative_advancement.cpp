#include <algorithm>

#include "continuous/search_impact.h"

namespace contactscope {

template <class S>
ImpactResult<S> conservative_advancement(const MovingShape<S>& a, const MovingShape<S>& b,
                                         const ImpactTolerance<S>& allowed, ImpactRun<S>* run) {
  const auto advance = [](const Approach<S>& approach, const Apart<S>& apart,
                          ImpactResult<S>& result, ImpactStep<S>& step) {
    const S speed = approach.closing_speed(apart.axis);
    const S left = S(1) - result.time;
    ++result.bounds;
    const S gap = apart.distance - apart.target;
    result.time = gap >= speed * left ? S(1) : result.time + gap / speed;
    step.bracket_end = step.distance >= speed * left ? S(1) : step.time + step.distance / speed;
    step.bracket_separation = apart.distance - speed * (step.bracket_end - step.time);
  };
  return search_impact(a, b, allowed, run, advance);
}

template decltype(conservative_advancement<float>) conservative_advancement<float>;
template decltype(conservative_advancement<double>) conservative_advancement<double>;

}  // namespace contactscope
