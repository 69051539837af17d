#include "support/pair_case.h"

#include <algorithm>
#include <utility>

namespace contactscope::test {
namespace {

Hull<double> random_shape(Random& random, double size, double longest_aspect) {
  const double aspect = random.chance(0.5) ? 1.0 : longest_aspect;
  const double kind = random.uniform(0, 1);
  if (kind < 0.4) return random_box(random, size, aspect);
  // Large hulls are rare because the oracle takes milliseconds for two of them.
  int vertices = 4 + random.index(13);
  if (kind > 0.85) vertices = 17 + random.index(16);
  if (kind > 0.96) vertices = 33 + random.index(32);
  return random_hull(random, vertices, size, aspect);
}

/// The vertex farthest along a direction, relative to the pose's position.
Vec3d support(const Hull<double>& hull, const Pose<double>& pose, const Vec3d& direction) {
  Vec3d best = pose.rotate(hull.vertices[0]);
  for (const Vec3d& vertex : hull.vertices) {
    const Vec3d turned = pose.rotate(vertex);
    if (direction.dot(turned) > direction.dot(best)) best = turned;
  }
  return best;
}

PairCase<double> placed_at_random(Random& random, PairCase<double> pair) {
  pair.pose_a.rotation = random.rotation();
  // Some pairs are parallel or almost so: their faces and edges are parallel.
  const double alignment = random.uniform(0, 1);
  pair.pose_b.rotation = random.rotation();
  if (alignment < 0.1) pair.pose_b.rotation = pair.pose_a.rotation;
  if (alignment < 0.05) {
    pair.pose_b.rotation = pair.pose_a.rotation * random.rotation_by(random.decade(-8, -1));
  }

  const Vec3d direction =
      random.chance(0.3) ? pair.pose_a.rotate(pair.a.planes[0].normal) : random.unit_vector();
  // Put B's support vertex on A's, then separate or push together, and shift a little sideways.
  const Vec3d meeting =
      support(pair.a, pair.pose_a, direction) - support(pair.b, pair.pose_b, Vec3d(-direction));
  const double smaller = std::min(pair.a.radius, pair.b.radius);
  const double distance = random.uniform(0, 1);
  double gap = -random.uniform(0, 1) * smaller;                      // deep
  if (distance < 0.75) gap = -random.decade(-5, -1) * smaller;       // a little
  if (distance < 0.30) gap = random.uniform(-1e-4, 1e-4) * smaller;  // touching
  if (distance < 0.20) gap = random.decade(-4, 1) * smaller;         // separated
  const Vec3d offset_aside = random.unit_vector();
  const Vec3d aside = random.decade(-6, 0) * smaller * offset_aside;
  pair.pose_b.position = meeting + gap * direction + aside - direction.dot(aside) * direction;
  return moved(pair, random.pose(5));
}

}  // namespace

PairCase<double> random_pair(Random& random) {
  PairCase<double> pair;
  pair.a = random_shape(random, random.decade(-2, 2), 100);
  pair.b = random_shape(random, random.decade(-2, 2), 100);
  return placed_at_random(random, std::move(pair));
}

PairCase<double> everyday_pair(Random& random) {
  PairCase<double> pair;
  pair.a = random_shape(random, random.uniform(0.2, 1), 4);
  pair.b = random_shape(random, random.uniform(0.2, 1), 4);
  return placed_at_random(random, std::move(pair));
}

}  // namespace contactscope::test
