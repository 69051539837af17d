#include "query/sat.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "geometry/primitives.h"
#include "support/brute_force_sat.h"
#include "support/pair_case.h"

namespace contactscope {
namespace {

using test::PairCase;
using test::Random;

/// The largest separation of far axes by definition: face normals, and many directions on A's arcs.
double sampled_far_separation(const PairCase<double>& pair, const Pose<double>& b_in_a,
                              const Vec3d& normal, double cosine) {
  double largest = -std::numeric_limits<double>::infinity();
  const auto add = [&](const Vec3d& direction) {
    const Vec3d unit = direction.normalized();
    if (unit.dot(normal) >= cosine) return;
    largest = std::max(largest, test::separation_along(unit, pair.a, {}, pair.b, b_in_a));
  };
  for (const Plane<double>& plane : pair.a.planes) add(plane.normal);
  for (const Plane<double>& plane : pair.b.planes) add(-b_in_a.rotate(plane.normal));
  constexpr int kSteps = 60;
  for (int edge = 0; edge < 2 * pair.a.edge_count(); edge += 2) {
    const auto face = [&](int half_edge) {
      return static_cast<std::size_t>(pair.a.half_edges[static_cast<std::size_t>(half_edge)].face);
    };
    const Vec3d first = pair.a.planes[face(edge)].normal;
    const Vec3d second = pair.a.planes[face(edge + 1)].normal;
    for (int k = 1; k < kSteps; ++k) add(first + (double(k) / kSteps) * (second - first));
  }
  return largest;
}

TEST(FarAxes, SlowNoFarDirectionOfAnArcHasALargerSeparationThanTheBoundNorIsTheBoundMuchLarger) {
  Random random(41);
  int bounded = 0, tight = 0;
  for (int i = 0; i < 150; ++i) {
    const PairCase<double> pair = test::everyday_pair(random);
    const Pose<double> b_in_a = relative_pose(pair.pose_a, pair.pose_b);
    const HullPair<double> placed(pair.a, pair.b, b_in_a);
    FaceSeparations<double> faces_a(placed.a), faces_b(placed.b);
    const SatResult<double> axes = sat(placed, 0.0, Preference::None, faces_a, faces_b);
    if (axes.status == SatStatus::Separated) continue;
    Vec3d normal = axes.edge.normal;
    if (axes.deepest == AxisKind::FaceA) normal = placed.a.normals[axes.face_a.face];
    if (axes.deepest == AxisKind::FaceB) normal = -placed.b.normals[axes.face_b.face];
    for (const double cosine : {0.4, 0.8, 0.95, 0.99}) {
      const double lowest = -std::numeric_limits<double>::infinity();
      const double bound = far_separation(placed, faces_a, faces_b, normal, cosine, lowest);
      const double far = sampled_far_separation(pair, b_in_a, normal, cosine);
      const double rounding = 1e-13 * test::length_scale(pair);
      EXPECT_GE(bound, far - rounding) << "pair " << i << ", cosine " << cosine;
      if (bound == std::numeric_limits<double>::infinity()) continue;
      ++bounded;
      tight += bound <= 0.9 * far;
      // A floor only saves work.
      const double floor = 0.5 * bound;
      EXPECT_EQ(far_separation(placed, faces_a, faces_b, normal, cosine, floor), floor);
      const double below = bound - 0.1 * placed.min_radius;
      EXPECT_NEAR(far_separation(placed, faces_a, faces_b, normal, cosine, below), bound,
                  1e-3 * placed.min_radius);
    }
  }
  EXPECT_GT(bounded, 100);
  EXPECT_GT(tight, 0.75 * bounded);
}

TEST(FarAxes, TheSideOfABoxIsFarFromItsTopAndItsOwnDepthIsTheBound) {
  // B overlaps A's top by 0.01 and A's side by 0.2.
  const Hull<double> cube = make_box(Vec3d(0.5, 0.5, 0.5));
  const HullPair<double> pair(cube, cube, {Quatd::Identity(), Vec3d(0.8, 0.99, 0)});
  FaceSeparations<double> faces_a(pair.a), faces_b(pair.b);
  sat(pair, 0.0, Preference::Relative, faces_a, faces_b);
  const double lowest = -std::numeric_limits<double>::infinity();
  // Along the arc from top (0.01 deep) to side (0.2 deep), the near border is the least deep: the
  // direction (0.6, 0.8, 0), with 0.8 * 0.01 + 0.6 * 0.2.
  EXPECT_NEAR(far_separation(pair, faces_a, faces_b, Vec3d(0, 1, 0), 0.8, lowest), -0.128, 1e-12);
  EXPECT_NEAR(far_separation(pair, faces_a, faces_b, Vec3d(0, 1, 0), 0.8, -0.02), -0.02, 1e-12);
}

}  // namespace
}  // namespace contactscope
