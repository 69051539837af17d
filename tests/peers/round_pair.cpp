#include "peers/round_pair.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "support/brute_force_distance.h"

namespace contactscope::peers {
namespace {

using test::Random;

Shape<double> random_shape(ShapeKind kind, Random& random) {
  const double radius = random.uniform(0.1, 0.5);
  const double half_height = random.uniform(0.1, 0.5);
  if (kind == ShapeKind::Sphere) return Sphere<double>{radius};
  if (kind == ShapeKind::Capsule) {
    return Capsule<double>{{Vec3d(0, -half_height, 0), Vec3d(0, half_height, 0)}, radius};
  }
  const double size = random.uniform(0.2, 1);
  if (random.chance(0.4)) return test::random_box(random, size, 3);
  return test::random_hull(random, 5 + random.index(28), size, 1);
}

/// The points of a shape without its radius.
std::vector<Vec3d> core_of(const Shape<double>& shape, const Pose<double>& pose) {
  std::vector<Vec3d> points = {Vec3d::Zero()};
  if (const auto* hull = std::get_if<Hull<double>>(&shape)) points = hull->vertices;
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape)) {
    points.assign(capsule->points.begin(), capsule->points.end());
  }
  for (Vec3d& point : points) point = pose.transform(point);
  return points;
}

test::Features features_of(const Shape<double>& shape, const Pose<double>& pose) {
  if (const auto* hull = std::get_if<Hull<double>>(&shape)) return test::features_of(*hull, pose);
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape)) {
    return test::features_of_segment(capsule->points[0], capsule->points[1], pose);
  }
  return test::features_of_point(Vec3d::Zero(), pose);
}

double gap_along(const Vec3d& direction, const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  double top = -std::numeric_limits<double>::infinity();
  double bottom = -top;
  for (const Vec3d& point : a) top = std::max(top, direction.dot(point));
  for (const Vec3d& point : b) bottom = std::min(bottom, direction.dot(point));
  return bottom - top;
}

/// Separation of two cores that overlap: along face normals, and perpendicular to an edge of each.
/// A point has neither; a segment is an edge.
double deepest_separation(const RoundPair& pair) {
  const std::vector<Vec3d> core_a = core_of(pair.a, pair.pose_a);
  const std::vector<Vec3d> core_b = core_of(pair.b, pair.pose_b);
  std::vector<Vec3d> axes;
  std::vector<Vec3d> edges[2];
  const auto collect = [&](const Shape<double>& shape, const Pose<double>& pose,
                           std::vector<Vec3d>& directions) {
    if (const auto* capsule = std::get_if<Capsule<double>>(&shape)) {
      directions.push_back(pose.rotate(capsule->points[1] - capsule->points[0]));
    }
    const auto* hull = std::get_if<Hull<double>>(&shape);
    if (hull == nullptr) return;
    for (const Plane<double>& plane : hull->planes) axes.push_back(pose.rotate(plane.normal));
    for (int e = 0; e < hull->edge_count(); ++e) {
      directions.push_back(pose.rotate(hull->target(2 * e) - hull->origin(2 * e)));
    }
  };
  collect(pair.a, pair.pose_a, edges[0]);
  collect(pair.b, pair.pose_b, edges[1]);
  for (const Vec3d& one : edges[0]) {
    for (const Vec3d& other : edges[1]) axes.push_back(one.cross(other));
  }
  double best = -std::numeric_limits<double>::infinity();
  for (const Vec3d& axis : axes) {
    const double length = axis.norm();
    if (length < 1e-12) continue;
    best = std::max(best, gap_along(axis / length, core_a, core_b));
    best = std::max(best, gap_along(-axis / length, core_a, core_b));
  }
  return best;
}

}  // namespace

double radius_of(const Shape<double>& shape) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape)) return sphere->radius;
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape)) return capsule->radius;
  return 0;
}

double length_scale(const RoundPair& pair) {
  const auto reach = [](const Shape<double>& shape) {
    double result = 0;
    for (const Vec3d& point : core_of(shape, {})) result = std::max(result, point.norm());
    return result + radius_of(shape);
  };
  return reach(pair.a) + reach(pair.b) + (pair.pose_b.position - pair.pose_a.position).norm();
}

double separation_along(const Vec3d& direction, const RoundPair& pair) {
  return gap_along(direction, core_of(pair.a, pair.pose_a), core_of(pair.b, pair.pose_b)) -
         radius_of(pair.a) - radius_of(pair.b);
}

double separation_by_exhaustion(const RoundPair& pair) {
  const double radii = radius_of(pair.a) + radius_of(pair.b);
  const test::BruteForceDistance separation = test::brute_force_distance(
      features_of(pair.a, pair.pose_a), features_of(pair.b, pair.pose_b));
  const auto distance = static_cast<double>(separation.distance);
  return (distance > 0 ? distance : deepest_separation(pair)) - radii;
}

RoundPair random_round_pair(ShapeKind a, ShapeKind b, Random& random) {
  RoundPair pair{random_shape(a, random),
                 {random.rotation(), Vec3d::Zero()},
                 random_shape(b, random),
                 {random.rotation(), Vec3d::Zero()}};
  const Vec3d unit_direction = random.unit_vector();
  const double touching = -separation_along(unit_direction, pair);
  const double depth = random.uniform(0, 1);
  double part = random.uniform(0, 1.05);                      // any
  if (depth < 0.5) part = 1 - 0.1 * random.uniform(-0.2, 1);  // a little
  pair.pose_b.position = part * touching * unit_direction;
  const Pose<double> whole = random.pose(5);
  pair.pose_a = compose(whole, pair.pose_a);
  pair.pose_b = compose(whole, pair.pose_b);
  const auto in_float = [](const Shape<double>& shape) {
    const Shape<float> rounded = shape_cast<float>(shape);
    if (const auto* hull = std::get_if<Hull<float>>(&rounded)) {
      return Shape<double>(hull_cast<double>(*hull));
    }
    if (const auto* sphere = std::get_if<Sphere<float>>(&rounded)) {
      return Shape<double>(Sphere<double>{sphere->radius});
    }
    const auto& capsule = std::get<Capsule<float>>(rounded);
    return Shape<double>(Capsule<double>{
        {capsule.points[0].cast<double>(), capsule.points[1].cast<double>()}, capsule.radius});
  };
  pair.a = in_float(pair.a);
  pair.b = in_float(pair.b);
  pair.pose_a = pair.pose_a.cast<float>().cast<double>();
  pair.pose_b = pair.pose_b.cast<float>().cast<double>();
  pair.pose_a.rotation.normalize();
  pair.pose_b.rotation.normalize();
  return pair;
}

}  // namespace contactscope::peers
