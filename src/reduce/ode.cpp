#include <cmath>
#include <numbers>

#include "reduce/convex_corners.h"

namespace contactscope {
namespace {

/// Of the area of the points' convex hull; of the corners when that has none.
template <class S>
Vec3<S> centroid(ContactPoints<S> points, const Vec3<S>& normal) {
  const Vec3<S> u = any_perpendicular(normal);
  const Vec3<S> v = normal.cross(u);
  const steps::Corners<S> hull = steps::convex_corners(points, u, v);
  const steps::Vec2<S> origin = hull[0].place;
  steps::Vec2<S> mean = steps::Vec2<S>::Zero();
  steps::Vec2<S> moment = steps::Vec2<S>::Zero();
  S area = S(0);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const steps::Vec2<S> a = hull[i].place - origin;
    const steps::Vec2<S> b = hull[(i + 1) % hull.size()].place - origin;
    const S triangle = steps::cross(a, b);
    mean += a;
    moment += triangle * (a + b);
    area += triangle;
  }
  const steps::Vec2<S> found =
      origin + (area > S(0) ? steps::Vec2<S>(moment / (S(3) * area))
                            : steps::Vec2<S>(mean / static_cast<S>(hull.size())));
  return steps::position(points, 0) + found.x() * u + found.y() * v;
}

/// As ODE culls the contacts of two boxes, written from a description. Steps: angles of all points
/// around the centroid of the area, from the deepest one; the deepest, which is therefore always
/// kept; for 90, 180 and 270 degrees the point not yet taken whose angle is nearest. Four points.
/// Deviation: the area is that of the convex hull, so that the order in which the points come does
/// not matter.
template <class S>
KeptIndices reduce_like_ode(ContactPoints<S> points, const Vec3<S>& normal,
                            const ReduceOptions& options) {
  constexpr S kTurn = S(2) * std::numbers::pi_v<S>;
  const int deepest = steps::deepest_point(points);
  const Vec3<S> middle = centroid(points, normal);
  const Vec3<S> u = steps::position(points, deepest) - middle;
  const Vec3<S> v = normal.cross(u);
  const auto angle = [&](int i) {
    const Vec3<S> offset = steps::position(points, i) - middle;
    const S turned = std::atan2(v.dot(offset), u.dot(offset));
    return turned < S(0) ? turned + kTurn : turned;
  };
  StaticVector<S, kMaxManifoldPoints> angles;
  for (int i = 0; i < count_of(points); ++i) angles.push_back(angle(i));

  KeptIndices choices;
  choices.push_back(deepest);
  for (int quarter = 1; quarter < 4; ++quarter) {
    const S wanted = S(quarter) * (kTurn / S(4));
    const int nearest = steps::highest(points, -std::numeric_limits<S>::infinity(), [&](int i) {
      if (steps::contains(choices, i)) return -std::numeric_limits<S>::infinity();
      const S apart = std::abs(wanted - at(angles, i));
      return -std::min(apart, kTurn - apart);
    });
    steps::add_once(choices, nearest);
  }
  return steps::first_of(choices, options);
}

}  // namespace

ReducerInfo ode_reducer() {
  return {"ode", "the deepest, then every 90 degrees", &reduce_like_ode<float>,
          &reduce_like_ode<double>};
}

}  // namespace contactscope
