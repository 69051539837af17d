#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "geometry/shape.h"
#include "manifold/dispatch.h"
#include "support/random_geometry.h"

/// Two shapes of any kind, and oracles that treat spheres and capsules as points and segments.
namespace contactscope::test {

struct PlacedShapes {
  Shape<double> a;
  Pose<double> pose_a;
  Shape<double> b;
  Pose<double> pose_b;
};

template <class S = double>
Manifolds<S> manifolds_of(const PlacedShapes& pair, const CollideOptions& options = {}) {
  Manifolds<S> manifolds;
  collide(shape_cast<S>(pair.a), pair.pose_a.template cast<S>(), shape_cast<S>(pair.b),
          pair.pose_b.template cast<S>(), options, manifolds);
  return manifolds;
}

inline Shape<double> ball(double radius) { return Sphere<double>{radius}; }
/// Along its y axis.
inline Shape<double> upright_capsule(double half_height, double radius) {
  return Capsule<double>{{Vec3d(0, -half_height, 0), Vec3d(0, half_height, 0)}, radius};
}
/// Along its x axis.
inline Shape<double> lying_capsule(double half_length, double radius) {
  return Capsule<double>{{Vec3d(-half_length, 0, 0), Vec3d(half_length, 0, 0)}, radius};
}
/// Everything below the x-z plane.
inline Shape<double> ground() { return HalfSpace<double>{{Vec3d::UnitY(), 0}}; }

/// Moves the whole pair; the relative pose stays.
inline PlacedShapes moved(const PlacedShapes& pair, const Pose<double>& by) {
  PlacedShapes result{pair.a, compose(by, pair.pose_a), pair.b, compose(by, pair.pose_b)};
  result.pose_a.rotation.normalize();
  result.pose_b.rotation.normalize();
  return result;
}

/// `value` rounded to scalar S.
template <class S> Vec3d rounded(const Vec3d& value) {
  return value.cast<S>().template cast<double>();
}
template <class S> double rounded(double value) {
  return static_cast<double>(static_cast<S>(value));
}
template <class S> Shape<double> rounded(const Shape<double>& shape) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape))
    return Sphere<double>{rounded<S>(sphere->radius)};
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape))
    return Capsule<double>{{rounded<S>(capsule->points[0]), rounded<S>(capsule->points[1])},
                           rounded<S>(capsule->radius)};
  if (const auto* hull = std::get_if<Hull<double>>(&shape))
    return hull_cast<double>(hull_cast<S>(*hull));
  const Plane<double>& plane = std::get<HalfSpace<double>>(shape).plane;
  return HalfSpace<double>{{rounded<S>(plane.normal), rounded<S>(plane.offset)}};
}

/// The exact input of the pipeline in scalar S.
template <class S> PlacedShapes rounded(const PlacedShapes& pair) {
  return {rounded<S>(pair.a), pair.pose_a.template cast<S>().template cast<double>(),
          rounded<S>(pair.b), pair.pose_b.template cast<S>().template cast<double>()};
}

/// The one manifold of two convex shapes; it has no points if there is no contact.
template <class S>
Manifold<S> manifold_of(const PlacedShapes& pair, const CollideOptions& options = {}) {
  Manifolds<S> manifolds;
  collide(shape_cast<S>(pair.a), pair.pose_a.template cast<S>(), shape_cast<S>(pair.b),
          pair.pose_b.template cast<S>(), options, manifolds);
  return manifolds.empty() ? Manifold<S>() : manifolds.front();
}

/// The record of the pair.
template <class S>
trace::Pair record_of(const PlacedShapes& pair, const CollideOptions& options = {},
                      const trace::Stages& stages = {}) {
  Manifolds<S> manifolds;
  trace::Pair record;
  record.a = "a";
  record.b = "b";
  collide(shape_cast<S>(pair.a), pair.pose_a.template cast<S>(), shape_cast<S>(pair.b),
          pair.pose_b.template cast<S>(), options, manifolds, nullptr, &record, stages);
  return record;
}

/// Ends of the core of a sphere or capsule in the world, and its radius.
struct Core {
  Vec3d from, to;
  double radius;

  Vec3d at(double t) const { return (1 - t) * from + t * to; }
  /// Largest extent along `direction`, metres.
  double support(const Vec3d& direction) const {
    return std::max(direction.dot(from), direction.dot(to));
  }
};

inline Core core_of(const Shape<double>& shape, const Pose<double>& pose) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape))
    return {pose.position, pose.position, sphere->radius};
  const auto& capsule = std::get<Capsule<double>>(shape);
  return {pose.transform(capsule.points[0]), pose.transform(capsule.points[1]), capsule.radius};
}

/// Minimum of a convex function over [0, 1], by ternary search.
template <class F> double least_by_search(const F& f) {
  double low = 0;
  double high = 1;
  for (int i = 0; i < 80; ++i) {  // to 1e-14 of the interval
    const double third = (high - low) / 3;
    if (f(low + third) <= f(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return f(0.5 * (low + high));
}

/// Signed distance of a point from the surface of a sphere or capsule, by search; metres.
inline double surface_distance(const Vec3d& point, const Core& core) {
  return least_by_search([&](double t) { return (core.at(t) - point).norm(); }) - core.radius;
}

/// Distance of the cores, by search in both parameters: both functions are convex.
inline double core_distance(const Core& a, const Core& b) {
  return least_by_search([&](double t) {
    const Vec3d on_a = a.at(t);
    return least_by_search([&](double u) { return (b.at(u) - on_a).norm(); });
  });
}

/// Separation of the cores along a direction from A to B, metres. It is at most their distance, and
/// equals it only along the direction of their closest points.
inline double gap_along(const Vec3d& direction, const Core& a, const Core& b) {
  return -b.support(-direction) - a.support(direction);
}

/// The largest length that limits the rounding of a coordinate of the pair.
inline double extent(const Core& a, const Core& b) {
  return (a.to - a.from).norm() + (b.to - b.from).norm() + a.radius + b.radius +
         (b.from - a.from).norm();
}

template <class S> double deepest_of(const Manifold<S>& manifold) {
  double least = std::numeric_limits<double>::infinity();
  for (const ContactPoint<S>& point : manifold.points) {
    least = std::min(least, static_cast<double>(point.separation));
  }
  return least;
}

template <class S> double deepest_of(const Manifolds<S>& manifolds) {
  double least = std::numeric_limits<double>::infinity();
  for (const Manifold<S>& manifold : manifolds) least = std::min(least, deepest_of(manifold));
  return least;
}

template <class S> Vec3d normal_of(const Manifold<S>& manifold) {
  return manifold.normal.template cast<double>();
}

template <class S> Vec3d position_of(const Manifold<S>& manifold, std::size_t index) {
  return manifold.points[index].position.template cast<double>();
}

template <class S> std::vector<std::string> ids_of(const Manifold<S>& manifold) {
  std::vector<std::string> ids;
  for (const ContactPoint<S>& point : manifold.points) ids.push_back(to_string(point.id));
  return ids;
}

template <class S> bool is_finite(const Manifold<S>& manifold) {
  bool finite = manifold.normal.allFinite();
  for (const ContactPoint<S>& point : manifold.points) {
    finite = finite && point.position.allFinite() && std::isfinite(point.separation);
  }
  return finite;
}

}  // namespace contactscope::test
