#include "bench/draw_round.h"

#include "query/gjk.h"

namespace contactscope::bench {
namespace {

using test::Random;

constexpr double kRadius = 0.25;
constexpr double kHalfHeight = 0.5;

using Segment = Vec3d[2];

constexpr double kFarSeparated = 3;

/// Moves B, whose core starts separated from A's, towards A along the closest points until the
/// rounded shapes overlap by 1 to 10 mm. The planes perpendicular to this path at both points keep
/// the cores separated, so their distance shrinks by just as much.
void leave_overlap(DrawnPair& pair, const SupportSet<double>& core_a,
                   const SupportSet<double>& core_b, double radii, Random& random) {
  const GjkResult<double> separated = gjk(core_a, core_b, relative_pose(pair.pose_a, pair.pose_b));
  const double wanted = radii - random.uniform(0.001, 0.010);
  pair.pose_b.position -= (separated.distance - wanted) * pair.pose_a.rotate(separated.normal);
}

Capsule<double> capsule() {
  return {{Vec3d(0, -kHalfHeight, 0), Vec3d(0, kHalfHeight, 0)}, kRadius};
}

}  // namespace

DrawnPair draw_round(Workload workload, Random& random) {
  const Segment ends = {capsule().points[0], capsule().points[1]};
  const Vec3d centre = Vec3d::Zero();
  DrawnPair pair;
  pair.pose_b = {random.rotation(), kFarSeparated * random.unit_vector()};
  if (workload == Workload::CapsuleCapsule) {
    pair.a = capsule();
    pair.b = capsule();
    leave_overlap(pair, support_set(ends), support_set(ends), 2 * kRadius, random);
    return pair;
  }
  const Hull<double> hull = test::random_hull(random, 32, 0.5, 1);
  pair.b = hull;
  if (workload == Workload::SphereHull) {
    pair.a = Sphere<double>{kRadius};
    leave_overlap(pair, support_set(centre), support_set(hull), kRadius, random);
  } else {
    pair.a = capsule();
    leave_overlap(pair, support_set(ends), support_set(hull), kRadius, random);
  }
  return pair;
}

}  // namespace contactscope::bench
