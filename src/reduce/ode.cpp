#include "reduce/ode.h"

#include <cmath>
#include <numbers>

#include "reduce/steps.h"

namespace contactscope {

/// Behaviour of ODE, written from a description. Steps: angles of all points around the centroid,
/// from the deepest one; the deepest; for 90, 180 and 270 degrees the point not yet taken whose
/// angle is nearest. Deviation: the centroid is the mean of the points, because that of the area
/// needs them in order around it.
template <class S>
KeptIndices reduce_like_ode(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                            const ReduceOptions& options) {
  constexpr S kTurn = S(2) * std::numbers::pi_v<S>;
  const int deepest = steps::deepest_point(points);
  const Vec3<S> middle = steps::centre(points);
  const Vec3<S> u = steps::at(points, deepest) - middle;
  const Vec3<S> v = normal.cross(u);
  const auto angle = [&](int i) {
    const Vec3<S> offset = steps::at(points, i) - middle;
    return std::atan2(v.dot(offset), u.dot(offset));
  };
  StaticVector<S, kMaxManifoldPoints> angles;
  for (int i = 0; i < steps::count(points); ++i) angles.push_back(angle(i));

  KeptIndices choices;
  choices.push_back(deepest);
  for (int quarter = 1; quarter < 4; ++quarter) {
    const S wanted = S(quarter) * (kTurn / S(4));
    const int nearest = steps::highest(points, -std::numeric_limits<S>::infinity(), [&](int i) {
      if (steps::contains(choices, i)) return -std::numeric_limits<S>::infinity();
      const S apart = std::abs(wanted - angles[static_cast<std::size_t>(i)]);
      return -std::min(apart, kTurn - apart);
    });
    steps::add_once(choices, nearest);
  }
  return steps::first_of(choices, options);
}

template KeptIndices reduce_like_ode(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                     const ReduceOptions&);
template KeptIndices reduce_like_ode(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                     const ReduceOptions&);

}  // namespace contactscope
