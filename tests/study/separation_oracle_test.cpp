#include "study/separation_oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/primitives.h"
#include "support/brute_force_distance.h"
#include "support/brute_force_sat.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Random;

Pose<double> at(double x, double y, double z) { return {Quatd::Identity(), Vec3d(x, y, z)}; }

double separation(const Shape<double>& a, const Pose<double>& pose_a, const Shape<double>& b,
                  const Pose<double>& pose_b) {
  return SeparationOracle(a, pose_a, b, pose_b).separation();
}

Shape<double> lying_capsule(double half_length, double radius) {
  return Capsule<double>{{Vec3d(-half_length, 0, 0), Vec3d(half_length, 0, 0)}, radius};
}

TEST(SeparationOracle, OverlappingHullsAgreeWithBruteForceOverAllAxes) {
  Random random(1);
  int overlapping = 0;
  for (int i = 0; i < 60; ++i) {
    const Hull<double> a = test::random_hull(random, 12, 1, 3);
    const Hull<double> b = test::random_box(random, 1, 4);
    const Pose<double> pose_a = random.pose(3);
    const Pose<double> pose_b{random.rotation(),
                              pose_a.position + random.uniform(0, 0.8) * random.unit_vector()};
    const double expected = test::brute_force_sat(a, pose_a, b, pose_b).separation;
    if (expected > 0) continue;
    ++overlapping;
    EXPECT_NEAR(separation(a, pose_a, b, pose_b), expected, 1e-13) << i;
  }
  EXPECT_GT(overlapping, 30);
}

TEST(SeparationOracle, SeparatedHullsHaveTheirDistance) {
  Random random(2);
  for (int i = 0; i < 40; ++i) {
    const Hull<double> a = test::random_hull(random, 8, 1, 3);
    const Hull<double> b = test::random_hull(random, 8, 1, 3);
    const Pose<double> pose_a = random.pose(3);
    const Pose<double> pose_b{random.rotation(),
                              pose_a.position + random.uniform(2.5, 4) * random.unit_vector()};
    const auto expected = static_cast<double>(
        test::brute_force_distance(test::features_of(a, pose_a), test::features_of(b, pose_b))
            .distance);
    ASSERT_GT(expected, 0);
    EXPECT_NEAR(separation(a, pose_a, b, pose_b), expected, 1e-13) << i;
  }
}

TEST(SeparationOracle, RoundShapesAreTheirCoresLessTheirRadii) {
  const Shape<double> ball = Sphere<double>{0.5};
  const Shape<double> box = make_box({1, 1, 1});
  const Shape<double> rod = lying_capsule(1, 0.25);
  EXPECT_NEAR(separation(ball, at(0, 0, 0), ball, at(3, 4, 0)), 4, 1e-15);
  EXPECT_NEAR(separation(rod, at(0, 0, 0), ball, at(2, 0, 0)), 0.25, 1e-15);
  EXPECT_NEAR(separation(box, at(0, 0, 0), ball, at(0.2, 1.4, 0)), -0.1, 1e-15);  // over a face
  EXPECT_NEAR(separation(box, at(0, 0, 0), ball, at(0.2, 0.9, 0)), -0.6, 1e-15);  // centre inside
  EXPECT_NEAR(separation(box, at(0, 0, 0), ball, at(2, 2, 2)), std::sqrt(3) - 0.5, 1e-15);
  EXPECT_NEAR(separation(box, at(0, 0, 0), rod, at(0, 1.2, 1.3)), std::hypot(0.2, 0.3) - 0.25,
              1e-15);                                                           // along an edge
  EXPECT_NEAR(separation(box, at(0, 0, 0), rod, at(0, 0.7, 0)), -0.55, 1e-15);  // axis inside
  const Pose<double> upright{Quatd(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3d::UnitZ())),
                             Vec3d(0, 0, 0.4)};
  EXPECT_NEAR(separation(rod, at(0, 0, 0), rod, upright), -0.1, 1e-15);  // crossed axes
}

TEST(SeparationOracle, PlanesAndMeshes) {
  const Shape<double> ground = HalfSpace<double>{{Vec3d::UnitY(), 0.5}};
  const Shape<double> grid = make_grid(4, 4, 2, 2, 0);
  const Shape<double> box = make_box({0.5, 0.5, 0.5});
  const Pose<double> edge_down{Quatd(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3d::UnitZ())),
                               Vec3d(0.3, 1, 0.2)};
  EXPECT_NEAR(separation(ground, at(0, 0, 0), box, edge_down), 0.5 - std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(separation(grid, at(0, 0.4, 0), box, edge_down), 0.6 - std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(separation(grid, at(0, 0, 0), Sphere<double>{0.25}, at(3, 0, 0)), 0.75, 1e-15);
}

TEST(SeparationOracle, NearlyParallelEdgesKeepTheirAxis) {
  // Two edges cross at 1e-12 rad and overlap by a tenth of the distance of their ends: their common
  // normal is the axis of least overlap. An axis slightly off it would cost far more than that.
  const Shape<double> box = make_box({0.5, 0.5, 0.5});
  const double half = std::sqrt(0.5);
  const Quatd edge_up(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3d::UnitX()));
  const double overlap = 1e-13;
  const Pose<double> pose_a{edge_up, Vec3d(0, -half, 0)};
  const Pose<double> pose_b{Quatd(Eigen::AngleAxisd(1e-12, Vec3d::UnitY())) * edge_up,
                            Vec3d(0, half - overlap, 0)};
  const SeparationOracle oracle(box, pose_a, box, pose_b);
  EXPECT_NEAR(oracle.separation(), -overlap, 4e-16);
  EXPECT_NEAR(oracle.separation_along(Vec3d::UnitY(), -1), -overlap, 4e-16);
}

TEST(SeparationOracle, NearlyParallelAxesKeepTheirDistance) {
  // Axes at a distance of 0.5 m that cross in their middle: the distance is that of their planes.
  const Shape<double> rod = lying_capsule(1, 0.25);
  for (double angle = 1e-16; angle < 1; angle *= 3) {
    const Pose<double> turned{Quatd(Eigen::AngleAxisd(angle, Vec3d::UnitY())), Vec3d(0, 0.5, 0)};
    EXPECT_NEAR(separation(rod, at(0.3, 0, 0), rod, turned), 0, 1e-16) << angle;
  }
}

TEST(SeparationOracle, AnyOtherNormalIsWorse) {
  Random random(3);
  const Shape<double> a = make_box({0.5, 0.3, 0.4});
  const Shape<double> b = test::random_hull(random, 10, 0.6, 2);
  const SeparationOracle oracle(a, random.pose(1), b, random.pose(0.3));
  for (int i = 0; i < 200; ++i) {
    EXPECT_LE(oracle.separation_along(random.unit_vector(), -1), oracle.separation() + 1e-15);
  }
}

TEST(SeparationOracle, FarFromTheOriginNothingIsLost) {
  const Shape<float> box = shape_cast<float>(make_box({0.5, 0.5, 0.5}));
  const Pose<float> below{Quat<float>::Identity(), Vec3<float>(586507, 586507, 586507)};
  const Pose<float> above{Quat<float>::Identity(), Vec3<float>(586507, 586507.9375f, 586507)};
  EXPECT_EQ(SeparationOracle(box, below, box, above).separation(), -0.0625);
}

}  // namespace
}  // namespace contactscope
