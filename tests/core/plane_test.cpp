#include "core/pose.h"

#include <gtest/gtest.h>

namespace contactscope {
namespace {

TEST(Plane, DistanceIsPositiveOnTheNormalsSide) {
  const Plane<double> floor{{0, 1, 0}, 2};
  EXPECT_EQ(floor.distance({5, 3, -7}), 1);
  EXPECT_EQ(floor.distance({5, 0.5, -7}), -1.5);
  EXPECT_EQ(floor.distance({5, 2, -7}), 0);
}

TEST(Plane, ProjectionKeepsWhatIsInThePlane) {
  const Plane<double> floor{{0, 1, 0}, 2};
  EXPECT_EQ(floor.project({5, 3, -7}), Vec3d(5, 2, -7));
  EXPECT_EQ(floor.project({5, -4, -7}), Vec3d(5, 2, -7));
}

TEST(Plane, TheFootOnATiltedPlaneIsTheNearestPoint) {
  const Plane<double> plane{Vec3d(2, 3, 6) / 7, 1.5};
  const Vec3d point(4, -5, 6);
  const Vec3d foot = plane.project(point);
  EXPECT_NEAR(plane.distance(foot), 0, 1e-15 * 10);
  const Vec3d perpendicular = point - foot;
  EXPECT_NEAR(perpendicular.cross(plane.normal).norm(), 0, 1e-14);
}

TEST(Plane, CastRoundsEachNumberOnce) {
  const Plane<float> rounded = Plane<double>{{0.6, 0.8, 0}, 0.1}.cast<float>();
  EXPECT_EQ(rounded.normal.x(), 0.6f);
  EXPECT_EQ(rounded.offset, 0.1f);
}

}  // namespace
}  // namespace contactscope
