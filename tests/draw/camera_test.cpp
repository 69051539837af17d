#include "draw/scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace contactscope::draw {
namespace {

const Rect kViewport{100, 50, 400, 300};

Camera looking_down_z() {
  return Camera::perspective({0, 0, 5}, {0, 0, 0}, Vec3d::UnitY(), 2 * std::atan(0.5), kViewport);
}

TEST(Camera, TargetIsInTheMiddleOfTheViewport) {
  const auto p = looking_down_z().project({0, 0, 0});
  ASSERT_TRUE(p);
  EXPECT_FLOAT_EQ(p->x, 300);
  EXPECT_FLOAT_EQ(p->y, 200);
}

TEST(Camera, FieldOfViewSpansTheViewportsHeight) {
  // At 5 m the half height of the view is 5 * tan(atan(0.5)) = 2.5 m; up is up on the screen.
  const auto top = looking_down_z().project({0, 2.5, 0});
  ASSERT_TRUE(top);
  EXPECT_NEAR(top->y, 50, 1e-3);
  EXPECT_NEAR(looking_down_z().pixels_per_metre({0, 0, 0}), 60, 1e-9);
}

TEST(Camera, OrthographicScaleDoesNotDependOnDistance) {
  const Camera camera = Camera::orthographic({0, 0, 5}, {0, 0, 0}, Vec3d::UnitY(), 3, kViewport);
  EXPECT_DOUBLE_EQ(camera.pixels_per_metre({0, 0, 0}), 100);
  EXPECT_FLOAT_EQ(camera.project({1, 0, -7})->x, 400);
  EXPECT_FLOAT_EQ(camera.project({1, 0, 2})->x, 400);
}

TEST(Camera, PointsBehindTheEyeAreNotProjected) {
  EXPECT_FALSE(looking_down_z().project({0, 0, 6}));
}

TEST(Camera, LookingAlongUpStillGivesAFrame) {
  const Camera camera = Camera::perspective({0, 4, 0}, {0, 0, 0}, Vec3d::UnitY(), 0.5, kViewport);
  EXPECT_NEAR(camera.right().norm(), 1, 1e-12);
  EXPECT_NEAR(camera.right().dot(camera.up()), 0, 1e-12);
  EXPECT_TRUE(camera.faces({0, 0, 0}, Vec3d::UnitY()));
  EXPECT_FALSE(camera.faces({0, 0, 0}, -Vec3d::UnitY()));
}

TEST(ProjectPolygon, FloorReachingBehindTheEyeIsCutAtTheViewport) {
  const std::vector<Vec3d> floor = {{-50, -1, -50}, {50, -1, -50}, {50, -1, 50}, {-50, -1, 50}};
  const std::vector<Point2> pixels = project_polygon(looking_down_z(), floor);
  ASSERT_GE(pixels.size(), 3u);
  double lowest = 0;
  for (const Point2& p : pixels) {
    EXPECT_GE(p.x, kViewport.x - 1e-3);
    EXPECT_LE(p.x, kViewport.x + kViewport.width + 1e-3);
    EXPECT_GE(p.y, 200 - 1e-3);  // below the horizon
    lowest = std::max<double>(lowest, p.y);
  }
  EXPECT_NEAR(lowest, kViewport.y + kViewport.height, 1e-2);
}

TEST(ProjectPolygon, OutsideTheViewportNothingIsLeft) {
  EXPECT_TRUE(project_polygon(looking_down_z(), {{9, 9, 0}, {10, 9, 0}, {9, 10, 0}}).empty());
}

TEST(ProjectSegment, PartInFrontOfTheEyeIsKept) {
  const auto seen = project_segment(looking_down_z(), {0, 0, 0}, {0, 0.5, 50});
  ASSERT_TRUE(seen);
  EXPECT_FLOAT_EQ(seen->from.x, 300);
  EXPECT_FALSE(project_segment(looking_down_z(), {0, 0, 6}, {1, 0, 7}));
}

}  // namespace
}  // namespace contactscope::draw
