#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "geometry/hull_builder.h"
#include "geometry/hull_checks.h"
#include "geometry/point_sets.h"

namespace contactscope::test {
namespace {

using ::testing::HasSubstr;

std::string refusal_of(const Points& points, const HullOptions& options = {}) {
  try {
    build_hull(points, options);
  } catch (const ShapeError& error) {
    return error.what();
  }
  throw std::runtime_error("the points made a hull");
}

TEST(BuildHullRefuses, FewerThanFourPoints) {
  for (const std::size_t count : {0u, 1u, 2u, 3u}) {
    Points points = box_grid(1);
    points.resize(count);
    const std::string refusal = refusal_of(points);
    EXPECT_THAT(refusal, HasSubstr("at least four points, got " + std::to_string(count)));
  }
}

TEST(BuildHullRefuses, CoordinatesThatAreNoNumbers) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Points points = box_grid(1);
    points[5].z() = bad;
    const std::string refusal = refusal_of(points);
    EXPECT_THAT(refusal, HasSubstr("must be a finite number"));
    EXPECT_THAT(refusal, HasSubstr("point 5"));
  }
}

TEST(BuildHullRefuses, ARepeatedPointNamingBoth) {
  Points points = box_grid(1);
  points.push_back(points[3]);
  const std::string refusal = refusal_of(points);
  EXPECT_THAT(refusal, HasSubstr("are both"));
  EXPECT_THAT(refusal, HasSubstr("points 3 and 8"));
  EXPECT_THAT(refusal, HasSubstr("(-0.5, 0.5, 0.5)"));
}

TEST(BuildHullRefuses, ARepeatedPointThatDiffersInTheSignOfZero) {
  const Points points = {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1),
                         Vec3d(-0.0, 0, 0)};
  EXPECT_THAT(refusal_of(points), HasSubstr("are both"));
}

TEST(BuildHull, WeldsRepeatedPointsOnRequest) {
  Points points = box_grid(2);
  const Points once = points;
  points.insert(points.end(), once.begin(), once.end());
  const Hull<double> hull = build_hull(points, {.weld_duplicates = true});
  EXPECT_TRUE(is_sound(hull));
  EXPECT_EQ(hull.vertices, build_hull(once).vertices);
}

TEST(BuildHullRefuses, FewerThanFourPointsAfterWelding) {
  const Points points = {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(1, 0, 0),
                         Vec3d(0, 1, 0)};
  const std::string refusal = refusal_of(points, {.weld_duplicates = true});
  EXPECT_THAT(refusal, HasSubstr("only 3 of the 5"));
}

TEST(BuildHullRefuses, PointsInOnePlaceUpToRounding) {
  const Vec3d far(1000, 2000, 3000);
  const Points points = {far, far + Vec3d(3e-13, 0, 0), far + Vec3d(0, 4e-13, 0),
                         far + Vec3d(0, 0, 1e-12)};
  EXPECT_THAT(refusal_of(without_repeats(points)), HasSubstr("of one place"));
}

TEST(BuildHullRefuses, PointsOnALine) {
  Generator random(1);
  for (int i = 0; i < 50; ++i) {
    Points points;
    for (int k = 0; k < 12; ++k) points.emplace_back(0, 0, k);
    if (i > 0) {
      points = rounded_to_float(
          transformed(points, random_rotation(random), std::pow(10.0, i % 9 - 4), Vec3d::Zero()));
    }
    const std::string refusal = refusal_of(points);
    EXPECT_THAT(refusal, HasSubstr("of one line")) << i;
    EXPECT_THAT(refusal, HasSubstr("all 12 points"));
  }
}

TEST(BuildHullRefuses, PointsInAPlane) {
  Generator random(2);
  for (int i = 0; i < 50; ++i) {
    Points points = in_box(random, 12, Vec3d(1, 0, 1));
    if (i > 0) {
      points = rounded_to_float(
          transformed(points, random_rotation(random), std::pow(10.0, i % 9 - 4), Vec3d::Zero()));
    }
    const std::string refusal = refusal_of(points);
    EXPECT_THAT(refusal, HasSubstr("a hull needs a point off that plane"));
  }
}

TEST(BuildHull, FourPointsAreEnoughOffOnePlane) {
  const Hull<double> hull =
      build_hull(Points{Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1e-3)});
  EXPECT_TRUE(is_sound(hull));
  EXPECT_EQ(hull.face_count(), 4);
}

TEST(BuildHullRefuses, AFaceWithTooManyVertices) {
  const std::string refusal = refusal_of(prism(129));
  EXPECT_THAT(refusal, HasSubstr("129 vertices"));
  EXPECT_EQ(build_hull(prism(128)).face_count(), 130);
}

TEST(BuildHull, CoordinatesOfAnyRepresentableSizeMakeAHull) {
  for (const double scale : {1e-300, 1e-160, 1e160, 1e300}) {
    Points points = box_grid(1);
    for (Vec3d& point : points) point *= scale;
    const Hull<double> hull = build_hull(points);
    EXPECT_TRUE(is_sound(hull)) << scale;
    EXPECT_EQ(hull.face_count(), 6);
    EXPECT_NEAR(hull.radius / scale, std::sqrt(0.75), 1e-12);
  }
}

}  // namespace
}  // namespace contactscope::test
