#pragma once

#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

#include "core/manifold.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"

/// Pairs of touching hulls, and motions for them.
namespace contactscope::test {

template <class S> bool same_bits(const Manifold<S>& one, const Manifold<S>& other) {
  if (one.axis != other.axis || one.type != other.type ||
      one.points.size() != other.points.size() ||
      std::memcmp(&one.normal, &other.normal, sizeof one.normal) != 0) {
    return false;
  }
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    const ContactPoint<S>& p = one.points[i];
    const ContactPoint<S>& q = other.points[i];
    if (p.position != q.position || p.separation != q.separation || p.id != q.id) return false;
  }
  return true;
}

/// A pair in motion: B's pose in frame k, from its pose in frame 0. `size` is the larger radius.
struct Motion {
  const char* name;
  std::function<Pose<double>(const Pose<double>& start, double size, int frame)> pose;
};

inline Pose<double> turned(const Pose<double>& pose, const Vec3d& axis, double angle) {
  return {(about(axis, angle) * pose.rotation).normalized(), pose.position};
}

/// New random motions for every pair.
inline std::vector<Motion> motions(Random& random, const Vec3d& normal) {
  const Vec3d axis = random.unit_vector();
  const Vec3d along = normal.cross(random.unit_vector()).normalized();
  const double seed = random.uniform(0, 6);
  return {
      {"rests, trembling",
       [=](const Pose<double>& start, double size, int k) {
         Pose<double> pose = turned(start, axis, 2e-4 * std::sin(5.1 * k + seed));
         pose.position += 1e-4 * size * std::sin(3.7 * k + seed) * along;
         return pose;
       }},
      {"slides",
       [=](const Pose<double>& start, double size, int k) {
         Pose<double> pose = turned(start, normal, 2e-3 * k);
         pose.position += 4e-3 * size * k * along;
         return pose;
       }},
      {"tumbles",
       [=](const Pose<double>& start, double, int k) { return turned(start, axis, 0.01 * k); }},
      {"leaves and comes back",
       [=](const Pose<double>& start, double size, int k) {
         Pose<double> pose = turned(start, axis, 0.1 * std::sin(0.03 * k));
         pose.position += 0.06 * size * std::sin(0.11 * k + seed) * normal;
         return pose;
       }},
  };
}

inline Hull<double> random_body(Random& random, double size) {
  if (random.chance(0.4)) return random_box(random, size, 4);
  const int vertices[] = {8, 16, 32, 64};
  return random_hull(random, vertices[random.index(4)], size, 3);
}

/// Two bodies that overlap by 0 to 4% of their size along the axis of least depth, and that axis.
inline PairCase<double> touching_pair(Random& random, Vec3d& normal) {
  const double size = random.decade(-4, 4);
  PairCase<double> pair{random_body(random, size), {}, random_body(random, size), {}};
  pair.pose_b = {random.rotation(), 0.5 * size * random.unit_vector()};
  if (random.chance(0.3)) pair.pose_b.rotation = random.rotation_by(1e-3);
  const BruteForceAxis axis = brute_force_sat(pair.a, pair.pose_a, pair.b, pair.pose_b);
  pair.pose_b.position += (-random.uniform(0, 0.04) * size - axis.separation) * axis.normal;
  normal = axis.normal;
  return pair;
}

}  // namespace contactscope::test
