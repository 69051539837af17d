#include "dynamics/sleep.h"

#include <gmock/gmock.h>

#include "support/random_geometry.h"

namespace contactscope::test {
namespace {

constexpr double kRestRounding = 1e-9;

/// Corners of a square of side 2 about the origin at height `y`, in order.
std::vector<Vec3d> square_corners(double y = 0) {
  return {{-1, y, -1}, {1, y, -1}, {1, y, 1}, {-1, y, 1}};
}

trace::Stability of(const std::vector<Vec3d>& points, const Vec3d& center) {
  return rest_of(points, Vec3d::UnitY(), center, kRestRounding);
}

TEST(Resting, NoPointsAreNoContact) {
  const trace::Stability none = of({}, Vec3d(1, 2, 3));
  EXPECT_EQ(none.verdict, "no contact");
  EXPECT_TRUE(none.support.empty());
}

TEST(Resting, FourFramesOfTheTalk) {
  const std::vector<Vec3d> corners = square_corners();
  const Vec3d center(0, 1, 0);
  const trace::Stability one = of({corners[0]}, center);
  EXPECT_EQ(one.verdict, "turns about a point");
  EXPECT_NEAR(one.margin, -std::sqrt(2.0), 1e-12);
  EXPECT_FALSE(one.axis);

  const trace::Stability two = of({corners[0], corners[2]}, center);
  EXPECT_EQ(two.verdict, "turns about a line");
  EXPECT_NEAR(two.margin, 0, 1e-12);
  ASSERT_TRUE(two.axis);
  EXPECT_NEAR((two.axis->at(1) - two.axis->at(0)).norm(), std::sqrt(8.0), 1e-12);

  // The centre of mass projects onto the diagonal, which is not inside.
  const trace::Stability three = of({corners[0], corners[2], corners[1]}, center);
  EXPECT_EQ(three.verdict, "turns about a line");
  EXPECT_EQ(three.support.size(), 3U);
  ASSERT_TRUE(three.axis);
  EXPECT_NEAR((three.axis->at(1) - three.axis->at(0)).norm(), std::sqrt(8.0), 1e-12);

  const trace::Stability four = of(corners, center);
  EXPECT_EQ(four.verdict, "stable");
  EXPECT_NEAR(four.margin, 1, 1e-12);
  EXPECT_FALSE(four.axis);
  EXPECT_NEAR((four.projection - Vec3d(0, 0, 0)).norm(), 0, 1e-12);
}

TEST(Resting, TheMarginIsTheDistanceToTheBorder) {
  EXPECT_NEAR(of(square_corners(), Vec3d(0.7, 3, 0.2)).margin, 0.3, 1e-12);
  const trace::Stability beyond_edge = of(square_corners(), Vec3d(1.25, 3, 0.2));
  EXPECT_EQ(beyond_edge.verdict, "turns about a line");
  EXPECT_NEAR(beyond_edge.margin, -0.25, 1e-12);
  EXPECT_NEAR(beyond_edge.axis->at(0).x(), 1, 1e-12);
  EXPECT_NEAR(beyond_edge.axis->at(1).x(), 1, 1e-12);
  const trace::Stability beyond_corner = of(square_corners(), Vec3d(1.3, 3, 1.4));
  EXPECT_EQ(beyond_corner.verdict, "turns about a point");
  EXPECT_NEAR(beyond_corner.margin, -0.5, 1e-12);
}

TEST(Resting, OnTheBorderWithinRoundingIsNotStable) {
  EXPECT_EQ(of(square_corners(), Vec3d(1 - 2 * kRestRounding, 1, 0)).verdict, "stable");
  for (const double x : {1 - 0.5 * kRestRounding, 1.0, 1 + 0.5 * kRestRounding}) {
    const trace::Stability border = of(square_corners(), Vec3d(x, 1, 0));
    EXPECT_EQ(border.verdict, "turns about a line") << x;
    ASSERT_TRUE(border.axis);
    EXPECT_NEAR(border.axis->at(0).x(), 1, 1e-12);
  }
}

TEST(Resting, PointsOnALineOrInOnePlaceAreNoArea) {
  const std::vector<Vec3d> line{{-1, 0, 0}, {0.2, 0, 1e-10}, {1, 0, 0}};
  EXPECT_EQ(of(line, Vec3d(0, 1, 0)).verdict, "turns about a line");
  const std::vector<Vec3d> place{{1, 0, 0}, {1, 0, 1e-10}, {1 + 1e-10, 0, 0}};
  EXPECT_EQ(of(place, Vec3d(1, 1, 0)).verdict, "turns about a point");
}

TEST(Resting, IsTheSameAtEveryScaleAndPose) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const double scale = random.decade(-4, 4);
    const Pose<double> pose = random.pose(3);
    const Vec3d center(random.uniform(-2, 2), 1, random.uniform(-2, 2));
    std::vector<Vec3d> moved;
    for (const Vec3d& corner : square_corners()) moved.push_back(scale * pose.transform(corner));
    const Vec3d moved_center = scale * pose.transform(center);
    const trace::Stability found =
        rest_of(moved, pose.rotate(Vec3d::UnitY()), moved_center,
                rounding_of(moved, moved_center, std::numeric_limits<double>::epsilon()));
    const trace::Stability expected = of(square_corners(), center);
    EXPECT_EQ(found.verdict, expected.verdict) << i;
    EXPECT_NEAR(found.margin, scale * expected.margin, 1e-12 * scale) << i;
  }
}

TEST(Resting, ARecordTakesAllManifolds) {
  trace::Pair pair;
  for (const double x : {-1.0, 1.0}) {
    trace::Manifold& manifold = pair.manifolds.emplace_back();
    manifold.normal = Vec3d::UnitY();
    for (const double z : {-1.0, 1.0}) manifold.points.push_back({Vec3d(x, 0, z), 0, ""});
  }
  const trace::Stability record = rest_of(pair, "crate", Vec3d(0.5, 1, 0), 1e-7);
  EXPECT_EQ(record.shape, "crate");
  EXPECT_EQ(record.verdict, "stable");
  EXPECT_EQ(record.support.size(), 4U);
  EXPECT_NEAR(record.margin, 0.5, 1e-12);
}

}  // namespace
}  // namespace contactscope::test
