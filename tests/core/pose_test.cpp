#include "core/pose.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace contactscope {
namespace {

constexpr double kPi = 3.14159265358979323846;

Pose<double> random_pose(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Quatd rotation(normal(random), normal(random), normal(random), normal(random));
  rotation.normalize();
  return {rotation, {normal(random), normal(random), normal(random)}};
}

/// Compared with x_parent = R x_local + p, with R written out from the axis and angle.
TEST(Pose, AQuarterTurnAboutYTakesXToMinusZ) {
  const Pose<double> pose{Quatd(std::sqrt(0.5), 0, std::sqrt(0.5), 0), {10, 20, 30}};
  EXPECT_NEAR((pose.transform({1, 2, 3}) - Vec3d(13, 22, 29)).norm(), 0, 1e-14);
  EXPECT_NEAR((pose.rotate({1, 2, 3}) - Vec3d(3, 2, -1)).norm(), 0, 1e-14);
}

TEST(Pose, InverseUndoesTransform) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const Pose<double> pose = random_pose(random);
    const Vec3d point = random_pose(random).position;
    EXPECT_NEAR((pose.inverse_transform(pose.transform(point)) - point).norm(), 0, 1e-14);
    EXPECT_NEAR((pose.inverse_rotate(pose.rotate(point)) - point).norm(), 0, 1e-14);
    EXPECT_NEAR(pose.rotate(point).norm(), point.norm(), 1e-14);
  }
}

TEST(Pose, RelativePoseGoesThroughTheCommonFrame) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const Pose<double> a = random_pose(random);
    const Pose<double> b = random_pose(random);
    const Vec3d local = random_pose(random).position;
    const Vec3d through_world = a.inverse_transform(b.transform(local));
    EXPECT_NEAR((relative_pose(a, b).transform(local) - through_world).norm(), 0, 1e-13);
    EXPECT_NEAR((compose(a, relative_pose(a, b)).position - b.position).norm(), 0, 1e-13);
  }
}

TEST(Pose, ComposeAppliesTheInnerPoseFirst) {
  const Pose<double> outer{Quatd(Eigen::AngleAxisd(kPi / 2, Vec3d::UnitZ())), {1, 0, 0}};
  const Pose<double> inner{Quatd::Identity(), {5, 0, 0}};
  EXPECT_NEAR((compose(outer, inner).transform({0, 0, 0}) - Vec3d(1, 5, 0)).norm(), 0, 1e-14);
}

// At ten million metres, neighbouring floats are a metre from each other. The offset of two bodies
// at such coordinates is still exact, because positions are subtracted first.
TEST(Pose, RelativePoseFarFromTheOriginLosesNothingMore) {
  const Pose<float> a{Quat<float>::Identity(), {1e7f, 0, 0}};
  const Pose<float> b{Quat<float>::Identity(), {1e7f + 3.0f, 0.25f, 0}};
  EXPECT_EQ(relative_pose(a, b).position, Vec3f(3.0f, 0.25f, 0));
}

TEST(Pose, CastKeepsTheOrderOfTheQuaternion) {
  const Pose<float> pose = Pose<double>{Quatd(0.1, 0.2, 0.3, 0.4), {1, 2, 3}}.cast<float>();
  EXPECT_EQ(pose.rotation.w(), 0.1f);
  EXPECT_EQ(pose.rotation.z(), 0.4f);
  EXPECT_EQ(pose.position, Vec3f(1, 2, 3));
}

}  // namespace
}  // namespace contactscope
