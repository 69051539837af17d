#include "bench/draw_hulls.h"

#include <cmath>
#include <numbers>

#include "geometry/primitives.h"
#include "query/sat.h"

namespace contactscope::bench {
namespace {

using test::PairCase;
using test::Random;

constexpr double kDegree = std::numbers::pi / 180;

Quatd turn(const Vec3d& axis, double angle) { return Quatd(Eigen::AngleAxisd(angle, axis)); }

Hull<double> unit_cube() { return make_box(Vec3d(0.5, 0.5, 0.5)); }

SatResult<double> axes_of(const PairCase<double>& pair) {
  const HullPair<double> placed(pair.a, pair.b, relative_pose(pair.pose_a, pair.pose_b));
  return sat(placed, 0.0, Preference::None);
}

/// World direction of an axis, from A to B.
Vec3d direction_of(const PairCase<double>& pair, const SatResult<double>& axes) {
  const HullPair<double> placed(pair.a, pair.b, relative_pose(pair.pose_a, pair.pose_b));
  if (axes.deepest == AxisKind::FaceA) {
    return pair.pose_a.rotate(placed.a.normals[axes.face_a.face]);
  }
  if (axes.deepest == AxisKind::FaceB) {
    return -pair.pose_a.rotate(placed.b.normals[axes.face_b.face]);
  }
  return pair.pose_a.rotate(axes.edge.normal);
}

/// Moves B out along the axis of least overlap to `overlap` metres. B moves less along other axes.
void leave_overlap(PairCase<double>& pair, double overlap) {
  const SatResult<double> axes = axes_of(pair);
  pair.pose_b.position += (-overlap - axes.separation(axes.deepest)) * direction_of(pair, axes);
}

PairCase<double> box_face(Random& random) {
  PairCase<double> pair{unit_cube(), {}, unit_cube(), {}};
  const Vec3d level = random.level(1, 0).normalized();
  const Quatd about_up = turn(Vec3d::UnitY(), random.uniform(5, 40) * kDegree);
  pair.pose_b.rotation = turn(level, random.uniform(0, 0.003)) * about_up;
  pair.pose_b.position = random.level(0.3, 0.9);
  leave_overlap(pair, random.uniform(0.001, 0.010));
  return pair;
}

PairCase<double> box_edge(Random& random) {
  PairCase<double> pair{unit_cube(), {}, unit_cube(), {}};
  const double roll_a = random.uniform(35, 55) * kDegree;
  const double roll_b = random.uniform(35, 55) * kDegree;
  const double crossing = random.uniform(50, 130) * kDegree;
  pair.pose_a.rotation = turn(Vec3d::UnitX(), roll_a);
  pair.pose_b.rotation = turn(Vec3d::UnitY(), crossing) * turn(Vec3d::UnitX(), roll_b);
  pair.pose_b.position = random.level(0.3, 1.3);
  leave_overlap(pair, random.uniform(0.001, 0.010));
  return pair;
}

Vec3d half_size_of_bounds(const Quatd& rotation) {
  return 0.5 * rotation.toRotationMatrix().cwiseAbs().rowwise().sum();
}

PairCase<double> box_random(Random& random) {
  PairCase<double> pair{unit_cube(), {random.rotation(), Vec3d::Zero()}, unit_cube(), {}};
  pair.pose_b.rotation = random.rotation();
  const Vec3d reach =
      half_size_of_bounds(pair.pose_a.rotation) + half_size_of_bounds(pair.pose_b.rotation);
  pair.pose_b.position = reach.cwiseProduct(random.vector(-1, 1));
  return pair;
}

PairCase<double> hull32(Random& random) {
  PairCase<double> pair{
      test::random_hull(random, 32, 0.5, 1), {}, test::random_hull(random, 32, 0.5, 1), {}};
  pair.pose_b.rotation = random.rotation();
  pair.pose_b.position = 0.6 * random.unit_vector();
  leave_overlap(pair, random.uniform(0.001, 0.010));
  return pair;
}

PairCase<double> draw(Workload workload, Random& random) {
  if (workload == Workload::BoxFace) return box_face(random);
  if (workload == Workload::BoxEdge) return box_edge(random);
  if (workload == Workload::BoxRandom) return box_random(random);
  return hull32(random);
}

/// Whether a random draw keeps the promise of its workload, which it may miss: a face axis in W1,
/// an edge axis in W2, every other pair separated in W3.
bool fits(Workload workload, const PairCase<double>& pair, std::size_t index) {
  const SatResult<double> axes = axes_of(pair);
  if (workload == Workload::BoxFace) return axes.deepest != AxisKind::EdgeEdge;
  if (workload == Workload::BoxEdge) return axes.deepest == AxisKind::EdgeEdge;
  if (workload == Workload::BoxRandom) {
    return (axes.status == SatStatus::Separated) == (index % 2 == 0);
  }
  return true;
}

}  // namespace

test::PairCase<double> draw_hulls(Workload workload, test::Random& random, std::size_t index) {
  for (;;) {
    PairCase<double> pair = draw(workload, random);
    if (fits(workload, pair, index)) return pair;
  }
}

}  // namespace contactscope::bench
