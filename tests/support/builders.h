#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/primitives.h"
#include "manifold/collide_pairs.h"
#include "support/pair_case.h"

/// Short builders for the geometry of tests.
namespace contactscope::test {

inline constexpr double kDegree = std::numbers::pi / 180;

inline Hull<double> cube(double half) { return make_box(Vec3d(half, half, half)); }

inline Pose<double> at(double x, double y, double z) { return {Quatd::Identity(), Vec3d(x, y, z)}; }

inline Quatd about(const Vec3d& axis, double radians) {
  return Quatd(Eigen::AngleAxisd(radians, axis.normalized()));
}

/// Two cubes of side `side`: the upper one with an edge down, the lower one with an edge up. The
/// edges cross at 80 degrees in the middle with the given overlap (metres). Normal is +y.
inline PairCase<double> crossed_edges(double side, double overlap) {
  const double half_diagonal = side / std::numbers::sqrt2;
  PairCase<double> pair{cube(side / 2), at(0, 0, 0), cube(side / 2),
                        at(0, 2 * half_diagonal - overlap, 0)};
  pair.pose_a.rotation = about(Vec3d::UnitX(), 45 * kDegree);
  pair.pose_b.rotation = about(Vec3d::UnitY(), 80 * kDegree) * about(Vec3d::UnitX(), 45 * kDegree);
  return pair;
}

/// Unit cube B on unit cube A, turned about y and overlapping by `overlap` metres. Normal is +y.
inline PairCase<double> stacked_cubes(double yaw, double overlap) {
  return {cube(0.5), at(0, 0, 0), cube(0.5), {about(Vec3d::UnitY(), yaw), {0, 1 - overlap, 0}}};
}

template <class S>
Manifold<S> collide(const PairCase<S>& pair, const CollideOptions& options = {}) {
  return collide_hull_hull(pair.a, pair.pose_a, pair.b, pair.pose_b, options);
}

template <class S> double deepest(const Manifold<S>& manifold) {
  double result = std::numeric_limits<double>::infinity();
  for (const ContactPoint<S>& point : manifold.points) {
    result = std::min(result, static_cast<double>(point.separation));
  }
  return result;
}

template <class S> std::vector<FeatureId> sorted_ids(const Manifold<S>& manifold) {
  std::vector<FeatureId> ids;
  for (const ContactPoint<S>& point : manifold.points) ids.push_back(point.id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// Distance from a place to the nearest point of the manifold; +infinity without points.
template <class S> double distance_to_nearest(const Manifold<S>& manifold, const Vec3d& place) {
  double least = std::numeric_limits<double>::infinity();
  for (const ContactPoint<S>& point : manifold.points) {
    least = std::min(least, (point.position.template cast<double>() - place).norm());
  }
  return least;
}

}  // namespace contactscope::test
