#include "round_hull_cases.h"

#include <algorithm>
#include <limits>

#include "support/brute_force_distance.h"

namespace contactscope::test {
namespace {

Shape<double> round_shape(const RoundHull& pair) {
  if (pair.is_sphere()) return Sphere<double>{pair.radius};
  return Capsule<double>{{pair.core[0], pair.core[1]}, pair.radius};
}

Features core_features(const RoundHull& pair) {
  return pair.is_sphere() ? features_of_point(pair.core[0], pair.round_pose)
                          : features_of_segment(pair.core[0], pair.core[1], pair.round_pose);
}

/// All directions that may be the shortest exit, with both signs; world frame, unit.
std::vector<Vec3d> axes(const RoundHull& pair) {
  std::vector<Vec3d> result;
  const auto add = [&](const Vec3d& axis) {
    if (axis.norm() == 0) return;
    result.push_back(pair.hull_pose.rotate(axis.normalized()));
    result.push_back(-result.back());
  };
  for (int f = 0; f < pair.hull.face_count(); ++f) {
    const std::vector<int> loop = face_vertices(pair.hull, f);
    // Newell's normal: the sum over all corners is correct even for slivers.
    Vec3d normal = Vec3d::Zero();
    const Vec3d& first = pair.hull.vertices[static_cast<std::size_t>(loop[0])];
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      const Vec3d p = pair.hull.vertices[static_cast<std::size_t>(loop[i])] - first;
      const Vec3d q = pair.hull.vertices[static_cast<std::size_t>(loop[i + 1])] - first;
      normal += p.cross(q);
    }
    add(normal);
  }
  if (pair.is_sphere()) return result;
  const Vec3d along =
      pair.hull_pose.inverse_rotate(pair.round_pose.rotate(pair.core[1] - pair.core[0]));
  for (int e = 0; e < pair.hull.edge_count(); ++e) {
    const Vec3d edge = pair.hull.target(2 * e) - pair.hull.origin(2 * e);
    const Vec3d cross = edge.cross(along);
    if (cross.norm() > 1e-12 * edge.norm() * along.norm()) add(cross);
  }
  return result;
}

}  // namespace

double RoundHull::scale() const {
  double reach = 0;
  for (const Vec3d& point : core) reach = std::max(reach, point.norm());
  return reach + radius + hull.centroid.norm() + hull.radius +
         (hull_pose.position - round_pose.position).norm();
}

Vec3d RoundHull::core_point(double parameter) const {
  return round_pose.transform(core.front() + parameter * (core.back() - core.front()));
}

template <class S> RoundHull rounded(const RoundHull& exact) {
  const auto twice = [](const Vec3d& v) {
    const Vec3<S> once = v.cast<S>();
    return Vec3d(once.template cast<double>());
  };
  RoundHull result{{},
                   static_cast<double>(static_cast<S>(exact.radius)),
                   exact.round_pose.cast<S>().template cast<double>(),
                   hull_cast<double>(hull_cast<S>(exact.hull)),
                   exact.hull_pose.cast<S>().template cast<double>()};
  for (const Vec3d& point : exact.core) result.core.push_back(twice(point));
  return result;
}

template <class S> Manifold<S> collide(const RoundHull& pair, const CollideOptions& options) {
  Manifolds<S> manifolds;
  collide<S>(shape_cast<S>(round_shape(pair)), pair.round_pose.cast<S>(),
             shape_cast<S>(Shape<double>(pair.hull)), pair.hull_pose.cast<S>(), options, manifolds);
  return manifolds.empty() ? Manifold<S>{} : manifolds.front();
}

double brute_force_separation(const RoundHull& pair) {
  const BruteForceDistance separation =
      brute_force_distance(core_features(pair), features_of(pair.hull, pair.hull_pose));
  if (separation.distance > 0) return static_cast<double>(separation.distance);
  double best = -std::numeric_limits<double>::infinity();
  for (const Vec3d& axis : axes(pair)) best = std::max(best, core_separation_along(axis, pair));
  return best;
}

Vec3d brute_force_normal(const RoundHull& pair) {
  const BruteForceDistance separation =
      brute_force_distance(core_features(pair), features_of(pair.hull, pair.hull_pose));
  const ExtendedPoint between = separation.on_b - separation.on_a;
  return between.normalized().cast<double>();
}

double core_separation_along(const Vec3d& direction, const RoundHull& pair) {
  // Relative to the round shape's position: no precision is lost far from the origin.
  double core_most = -std::numeric_limits<double>::infinity();
  double hull_least = std::numeric_limits<double>::infinity();
  const Vec3d between = pair.hull_pose.position - pair.round_pose.position;
  for (const Vec3d& point : pair.core) {
    core_most = std::max(core_most, direction.dot(pair.round_pose.rotate(point)));
  }
  for (const Vec3d& vertex : pair.hull.vertices) {
    hull_least =
        std::min(hull_least, direction.dot(Vec3d(pair.hull_pose.rotate(vertex) + between)));
  }
  return hull_least - core_most;
}

double distance_from_hull(const Vec3d& point, const RoundHull& pair) {
  return static_cast<double>(
      brute_force_distance(features_of_point(point, {}), features_of(pair.hull, pair.hull_pose))
          .distance);
}

double unevenness(const Hull<double>& hull) {
  double most = 0;
  for (int f = 0; f < hull.face_count(); ++f) {
    for (const int vertex : face_vertices(hull, f)) {
      const Vec3d& corner = hull.vertices[static_cast<std::size_t>(vertex)];
      most = std::max(most, std::abs(hull.planes[static_cast<std::size_t>(f)].distance(corner)));
    }
  }
  return most;
}

RoundHull random_round_hull(Random& random, bool sphere, double ratio) {
  const double size = random.decade(-4, 4);
  const double aspect = random.chance(0.3) ? random.decade(0, 4) : random.uniform(1, 4);
  const Hull<double> hull =
      random.chance(0.4) ? random_box(random, size, aspect)
                         : random_hull(random, 4 + random.index(61), size, std::min(aspect, 100.0));
  const double exponent = std::log10(ratio);
  const double round_size = size * random.decade(-exponent, exponent);
  RoundHull pair{{Vec3d::Zero()}, round_size * random.decade(-2, 0), {}, hull, {}};
  if (!sphere) {
    const Vec3d middle =
        random.chance(0.5) ? Vec3d(Vec3d::Zero()) : Vec3d(round_size * random.unit_vector());
    const Vec3d half = 0.5 * round_size * random.unit_vector();
    pair.core = {middle - half, middle + half};
  }
  pair.hull_pose.rotation = random.rotation();
  pair.round_pose.rotation = random.rotation();

  // A point on or in the hull, and a point of the core at some height above it.
  double weight_sum = 0;
  Vec3d target = Vec3d::Zero();
  const int corners = 1 + random.index(4);
  const std::vector<int> loop = face_vertices(hull, random.index(hull.face_count()));
  for (int i = 0; i < corners; ++i) {
    const bool any = random.chance(0.1);
    const int vertex =
        any ? random.index(hull.vertex_count())
            : loop[static_cast<std::size_t>(random.index(static_cast<int>(loop.size())))];
    const double weight = random.uniform(0.05, 1);
    target += weight * hull.vertices[static_cast<std::size_t>(vertex)];
    weight_sum += weight;
  }
  target /= weight_sum;
  const Vec3d outward = (target - hull.centroid).normalized() + 0.8 * random.unit_vector();
  double height = pair.radius * random.uniform(-0.1, 1.1);
  if (random.chance(0.3)) height = -hull.radius * random.decade(-4, -0.3);
  if (random.chance(0.1)) height = pair.radius * random.decade(-6, -2);
  if (random.chance(0.05)) height = 0;
  const double parameter = random.chance(0.4) ? random.index(2) : random.uniform(0, 1);
  const Vec3d core = pair.core.front() + parameter * (pair.core.back() - pair.core.front());
  const Vec3d place = pair.hull_pose.transform(target + height * outward.normalized());
  pair.round_pose.position = place - pair.round_pose.rotate(core);

  const Pose<double> by = random.pose(size);
  pair.hull_pose = compose(by, pair.hull_pose);
  pair.round_pose = compose(by, pair.round_pose);
  pair.hull_pose.rotation.normalize();
  pair.round_pose.rotation.normalize();
  return pair;
}

template RoundHull rounded<float>(const RoundHull&);
template RoundHull rounded<double>(const RoundHull&);
template Manifold<float> collide(const RoundHull&, const CollideOptions&);
template Manifold<double> collide(const RoundHull&, const CollideOptions&);

}  // namespace contactscope::test
