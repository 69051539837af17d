#include "geometry/hull_checks.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "geometry/hull_builder.h"
#include "geometry/point_sets.h"
#include "geometry/primitives.h"
#include "geometry/qhull_oracle.h"

// The checks that other tests rely on must be able to fail.
namespace contactscope::test {
namespace {

const Hull<double> kBox = make_box(Vec3d(1, 2, 3));

TEST(HullChecks, ABoxIsSoundAndConvex) {
  EXPECT_TRUE(is_sound(kBox));
  EXPECT_TRUE(is_convex(kBox, 0));
  EXPECT_DOUBLE_EQ(measure(kBox).volume, 48);
  EXPECT_DOUBLE_EQ(measure(kBox).area, 88);
}

TEST(HullChecks, BrokenTopologyIsNotSound) {
  Hull<double> hull = kBox;
  std::swap(hull.half_edges[0].next, hull.half_edges[2].next);
  EXPECT_FALSE(is_sound(hull));
  hull = kBox;
  std::swap(hull.half_edges[0], hull.half_edges[1]);
  EXPECT_FALSE(is_sound(hull));
  hull = kBox;
  hull.half_edges[5].face = 0;
  EXPECT_FALSE(is_sound(hull));
  hull = kBox;
  hull.vertices.emplace_back(0, 0, 0);
  EXPECT_FALSE(is_sound(hull));
}

TEST(HullChecks, AVertexOfTwoEdgesIsNotSound) {
  // A tetrahedron with a vertex inserted into the edge from 0 to 1.
  const Hull<double> hull = hull_from_polygons(
      {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1), Vec3d(0.5, 0, 0)},
      {{0, 2, 1, 4}, {0, 4, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  EXPECT_FALSE(is_sound(hull));
}

TEST(HullChecks, StaleLanesAreNotSound) {
  Hull<double> hull = kBox;
  hull.planes[2].offset += 1e-12;
  EXPECT_FALSE(is_sound(hull));
  lay_out(hull);
  EXPECT_TRUE(is_sound(hull));
}

TEST(HullChecks, ADentIsNotConvex) {
  Hull<double> hull = kBox;
  hull.vertices[3] *= 0.999;
  EXPECT_FALSE(is_convex(hull, 1e-6));
  EXPECT_TRUE(is_convex(hull, 0.01));
  hull = kBox;
  hull.planes[2].offset -= 1e-5;
  EXPECT_FALSE(is_convex(hull, 1e-6));
  hull = kBox;
  hull.planes[2].normal *= -1;
  EXPECT_FALSE(is_convex(hull, 1e-6));
}

TEST(HullChecks, AnOutlineThatTurnsInwardsIsNotConvex) {
  // An arrow-shaped prism with flat caps; its notch is at corner 2 of each.
  const std::vector<Vec3d> outline = {Vec3d(0, 0, 2), Vec3d(2, 0, -2), Vec3d(0, 0, -1),
                                      Vec3d(-2, 0, -2)};
  std::vector<Vec3d> vertices = outline;
  for (const Vec3d& corner : outline) vertices.emplace_back(corner - Vec3d(0, 1, 0));
  Hull<double> hull = hull_from_polygons(
      vertices,
      {{0, 1, 2, 3}, {7, 6, 5, 4}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}});
  EXPECT_TRUE(is_sound(hull));
  // Move the planes at the notch away, so that only the outline can reveal it.
  hull.planes[3].offset += 10;
  hull.planes[4].offset += 10;
  const ::testing::AssertionResult result = is_convex(hull, 1e-6);
  EXPECT_FALSE(result);
  EXPECT_NE(std::string(result.message()).find("turns inwards"), std::string::npos);
}

TEST(HullChecks, SupportErrorSeesAMissingCorner) {
  const Points cube = box_grid(1);
  EXPECT_EQ(support_error(make_box(Vec3d::Constant(0.5)), cube, {Vec3d(1, 1, 1)}), 0);
  EXPECT_NEAR(support_error(make_box(Vec3d::Constant(0.4)), cube, {Vec3d(1, 1, 1)}), 0.3, 1e-15);
}

TEST(QhullOracle, KnowsACube) {
  const QhullAnswer answer = run_qhull(box_grid(2));
  EXPECT_NEAR(answer.volume, 1, 1e-12);
  EXPECT_NEAR(answer.area, 6, 1e-12);
}

}  // namespace
}  // namespace contactscope::test
