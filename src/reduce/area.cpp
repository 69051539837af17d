#include "reduce/area.h"

#include <cmath>

#include "reduce/grow.h"

namespace contactscope {

/// It leans on no coordinate axis, because boxes and floors do, and two corners of an aligned box
/// would be equally far along an axis: rounding would then choose between them anew in every frame.
template <class S>
Vec3<S> fixed_direction(const Vec3<S>& normal) {
  const Vec3<S> one(S(0.76), S(0.31), S(0.57));
  const Vec3<S> two(S(-0.57), S(0.76), S(0.31));
  // The steeper one would have a short projection, and swing with the smallest change of normal.
  const Vec3<S>& chosen = std::abs(normal.dot(one)) <= S(0.9) ? one : two;
  return chosen - normal.dot(chosen) * normal;
}

/// Gregorius 2015, "Contact Point Reduction: 1st Point" to "4th Point (5)"; grow_from() has the
/// steps from the second point on. Deviation: when all points lie on one line the first is
/// exchanged for the other extreme, because the support point may lie between.
template <class S>
KeptIndices reduce_by_area(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                           const ReduceOptions& options) {
  return steps::grow_from<steps::Added::Area>(points, normal,
                                              steps::support_point(points, fixed_direction(normal)),
                                              steps::OnALine::ExchangeFirst, options.max_points);
}

template Vec3<float> fixed_direction(const Vec3<float>&);
template Vec3<double> fixed_direction(const Vec3<double>&);
template KeptIndices reduce_by_area(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                    const ReduceOptions&);
template KeptIndices reduce_by_area(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                    const ReduceOptions&);

}  // namespace contactscope
