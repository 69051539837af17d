#include <cmath>

#include "reduce/steps.h"

namespace contactscope {
namespace {

/// As MJX reduces a clip polygon, written from a description. Steps: the first point given; the
/// farthest from it; the farthest from the line through both, on either side; the farthest from the
/// other two edges of that triangle, on either side of them, by area. A corner of the triangle may
/// win, which wastes the fourth choice: three points are left. Four points at most. Deviation: that
/// corner is not reported twice.
template <class S>
KeptIndices reduce_like_mjx(ContactPoints<S> points, const Vec3<S>& normal,
                            const ReduceOptions& options) {
  const int a = 0;
  const int b = steps::farthest_from(points, a);
  const auto area = [&](int q, int from, int to) {
    return std::abs(steps::doubled_area(steps::position(points, q), steps::position(points, from),
                                        steps::position(points, to), normal));
  };
  KeptIndices choices;
  choices.push_back(a);
  steps::add_once(choices, b);
  const int c = steps::highest(points, steps::negligible_area(points, a, b),
                               [&](int q) { return area(q, a, b); });
  if (c >= 0) {
    choices.push_back(c);
    steps::add_once(choices, steps::highest(points, S(0), [&](int q) {
                      return std::max(area(q, b, c), area(q, a, c));
                    }));
  }
  return steps::first_of(choices, options);
}

}  // namespace

ReducerInfo mjx_reducer() {
  return {"mjx", "the first, farthest from it, from the line, from the edges",
          &reduce_like_mjx<float>, &reduce_like_mjx<double>};
}

}  // namespace contactscope
