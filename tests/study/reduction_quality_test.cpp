#include "study/exploration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/random_geometry.h"

namespace contactscope {
namespace {

using Points = std::vector<ContactPoint<double>>;

ContactPoint<double> point(double x, double z, double separation = -0.01) {
  return {Vec3d(x, 0, z), separation, FeatureId{}};
}

trace::ReducerAnswer measured(const Points& points, const std::vector<int>& kept) {
  return measure_reduction(points, Vec3d::UnitY(), kept, 4);
}

const Points kRectangle = {point(-2, -1), point(2, -1), point(2, 1), point(-2, 1)};

Points with(Points points, const ContactPoint<double>& added) {
  points.push_back(added);
  return points;
}

TEST(ReductionQuality, AllCornersLoseNothing) {
  const trace::ReducerAnswer quality = measured(with(kRectangle, point(0, 0)), {0, 1, 2, 3});
  EXPECT_DOUBLE_EQ(quality.area, 8);
  EXPECT_DOUBLE_EQ(quality.area_ratio, 1);
  EXPECT_NEAR(quality.wrench_error, 0, 1e-15);
  EXPECT_NEAR(quality.depth_error, 0, 1e-15);
}

TEST(ReductionQuality, LostCornerCostsItsDistanceFromTheTriangle) {
  // The corner (2, 1) is 4 / sqrt(5) from the remaining diagonal.
  const Points points = with(kRectangle, point(0, 0));
  const trace::ReducerAnswer quality = measured(points, {0, 1, 3, 4});
  EXPECT_DOUBLE_EQ(quality.area_ratio, 0.5);
  EXPECT_NEAR(quality.wrench_error, 4 / std::sqrt(5.0) / std::sqrt(5.0), 1e-12);
}

TEST(ReductionQuality, OnePointLeavesTheFarthestUncovered) {
  const trace::ReducerAnswer quality = measured(kRectangle, {0});
  EXPECT_DOUBLE_EQ(quality.area_ratio, 0);
  EXPECT_NEAR(quality.wrench_error, 2, 1e-12);  // the diagonal, in radii
}

TEST(ReductionQuality, WrenchErrorIsTheLargestShortfallOfReachOverDirections) {
  test::Random random(4);
  for (int round = 0; round < 200; ++round) {
    Points points;
    const int count = 5 + random.index(8);
    Vec3d mean = Vec3d::Zero();
    for (int i = 0; i < count; ++i) {
      points.push_back(point(random.uniform(-1, 1), random.uniform(-1, 1)));
      mean += points.back().position / count;
    }
    const std::vector<int> kept = {0, 1, 2, 3};
    double radius = 0;
    for (const auto& p : points) radius = std::max(radius, (p.position - mean).norm());
    double shortfall = 0;
    for (int k = 0; k < 4000; ++k) {
      const double angle = 2 * std::numbers::pi * k / 4000;
      const Vec3d direction(std::cos(angle), 0, std::sin(angle));
      double reach = -10;
      double kept_reach = -10;
      for (const auto& p : points) reach = std::max(reach, direction.dot(p.position));
      for (const int i : kept) {
        kept_reach =
            std::max(kept_reach, direction.dot(points[static_cast<std::size_t>(i)].position));
      }
      shortfall = std::max(shortfall, reach - kept_reach);
    }
    // Directions are sampled, so the largest shortfall may be missed by the reach times a step.
    const double wrench_error = measured(points, kept).wrench_error;
    EXPECT_LE(shortfall / radius, wrench_error + 1e-12);
    EXPECT_GE(shortfall / radius, wrench_error - 4 * 2 * std::numbers::pi / 4000);
  }
}

TEST(ReductionQuality, DeepestIsKeptOrNot) {
  Points points = with(kRectangle, point(0, 0, -0.02));
  EXPECT_FALSE(measured(points, {0, 1, 2, 3}).deepest_kept);
  EXPECT_TRUE(measured(points, {4}).deepest_kept);
  points.push_back(point(1, 0, -0.02));
  EXPECT_TRUE(measured(points, {0, 1, 2, 5}).deepest_kept) << "one of two that are as deep";
}

TEST(ReductionQuality, DepthErrorIsTheDeviationFromAPlane) {
  Points tilted;
  for (const auto& p : kRectangle) {
    tilted.push_back(point(p.position.x(), p.position.z(), -0.02 + 0.003 * p.position.x()));
  }
  tilted.push_back(point(0.5, 0.5, -0.02 + 0.0015));
  EXPECT_NEAR(measured(tilted, {0, 1, 2}).depth_error, 0, 1e-15);
  tilted[4].separation -= 0.004;
  EXPECT_NEAR(measured(tilted, {0, 1, 2, 3}).depth_error, 0.004, 1e-15);
  // Two points along x still give the slope along x; across, they count as level.
  EXPECT_NEAR(measured(tilted, {0, 1}).depth_error, 0.004, 1e-15);
}

TEST(ReductionQuality, IsTheSameInEveryPose) {
  test::Random random(9);
  const Points points = with(with(kRectangle, point(0.3, 0.8, -0.02)), point(2.5, 0, -0.005));
  const trace::ReducerAnswer here = measured(points, {0, 1, 2, 5});
  for (int round = 0; round < 50; ++round) {
    const Pose<double> pose = random.pose(10);
    Points moved = points;
    for (auto& p : moved) p.position = pose.rotation * p.position + pose.position;
    const trace::ReducerAnswer there =
        measure_reduction(moved, pose.rotation * Vec3d::UnitY(), std::vector<int>{0, 1, 2, 5}, 4);
    EXPECT_NEAR(there.area_ratio, here.area_ratio, 1e-12);
    EXPECT_NEAR(there.wrench_error, here.wrench_error, 1e-12);
    EXPECT_NEAR(there.depth_error, here.depth_error, 1e-12);
  }
}

TEST(ReductionQuality, NoPointsLoseNothingAndNothingKeptLosesAll) {
  EXPECT_DOUBLE_EQ(measured({}, {}).area_ratio, 1);
  EXPECT_DOUBLE_EQ(measured(kRectangle, {}).area_ratio, 0);
  EXPECT_DOUBLE_EQ(measured(kRectangle, {}).wrench_error, 1);
}

TEST(Supports, WeightOverThePolygonItsEdgeAndOutside) {
  const std::vector<int> all = {0, 1, 2, 3};
  const std::vector<int> half = {0, 1, 3};
  EXPECT_TRUE(supports(kRectangle, Vec3d::UnitY(), all, Vec3d(0.5, 7, 0.5)));
  EXPECT_TRUE(supports(kRectangle, Vec3d::UnitY(), half, Vec3d(0, 7, 0)));
  EXPECT_FALSE(supports(kRectangle, Vec3d::UnitY(), half, Vec3d(0.5, 7, 0.5)));
  EXPECT_FALSE(supports(kRectangle, Vec3d::UnitY(), {}, Vec3d(0, 0, 0)));
  EXPECT_TRUE(supports(kRectangle, Vec3d::UnitY(), std::vector<int>{2}, Vec3d(2, 0, 1)));
}

}  // namespace
}  // namespace contactscope
