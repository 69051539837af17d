#include "reduce/mjx.h"

#include <cmath>

#include "reduce/steps.h"

namespace contactscope {

/// Behaviour of MJX, written from a description. Steps: the first point given; the farthest from
/// it; the farthest from the line through both, on either side; the farthest from the other two
/// edges of that triangle, on either side of them, by area. A corner of the triangle may win, which
/// wastes the fourth choice. Deviation: that corner is not reported twice.
template <class S>
KeptIndices reduce_like_mjx(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                            const ReduceOptions& options) {
  const int a = 0;
  const int b = steps::farthest_from(points, a);
  const auto area = [&](int q, int from, int to) {
    return std::abs(steps::doubled_area(steps::at(points, q), steps::at(points, from),
                                        steps::at(points, to), normal));
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

template KeptIndices reduce_like_mjx(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                     const ReduceOptions&);
template KeptIndices reduce_like_mjx(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                     const ReduceOptions&);

}  // namespace contactscope
