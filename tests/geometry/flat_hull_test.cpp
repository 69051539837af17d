#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "geometry/hull_builder.h"
#include "geometry/hull_checks.h"
#include "geometry/point_sets.h"

/// Hulls of points in one plane: a polygon with two faces back to back.
namespace contactscope::test {
namespace {

using ::testing::HasSubstr;

Hull<double> flat_hull_of(const Points& points) { return build_hull(points, {.allow_flat = true}); }

/// Expects the promised topology and planes of a flat hull, and convexity within `tolerance`.
void expect_flat(const Hull<double>& hull, double tolerance) {
  ASSERT_TRUE(hull.flat());
  const std::vector<int> front = face_vertices(hull, 0);
  std::vector<int> back = face_vertices(hull, 1);
  EXPECT_EQ(front.size(), hull.vertices.size());
  EXPECT_EQ(hull.edge_count(), hull.vertex_count());
  std::ranges::reverse(back);
  std::rotate(back.begin(), std::ranges::find(back, front[0]), back.end());
  EXPECT_EQ(back, front);
  EXPECT_EQ(hull.planes[1].normal, Vec3d(-hull.planes[0].normal));
  EXPECT_EQ(hull.planes[1].offset, -hull.planes[0].offset);
  EXPECT_NEAR(hull.planes[0].normal.norm(), 1, 1e-14);
  for (std::size_t i = 0; i < front.size(); ++i) {
    const Vec3d from = hull.vertices[static_cast<std::size_t>(front[i])];
    const Vec3d to = hull.vertices[static_cast<std::size_t>(front[(i + 1) % front.size()])];
    const Vec3d inward = hull.planes[0].normal.cross(Vec3d((to - from).normalized()));
    for (const Vec3d& vertex : hull.vertices) {
      EXPECT_NEAR(hull.planes[0].distance(vertex), 0, tolerance);
      EXPECT_GE(inward.dot(Vec3d(vertex - from)), -tolerance);
    }
  }
}

TEST(FlatHull, IsTheConvexPolygonOfPointsOnAPlane) {
  Generator random(2);
  for (int i = 0; i < 200; ++i) {
    const double scale = std::pow(10.0, i % 9 - 4);
    Points points = in_box(random, 3 + i % 30, Vec3d(1, 0, 0.2 + 0.004 * i));
    points = rounded_to_float(
        transformed(points, random_rotation(random), scale, scale * Vec3d(0.3, -0.2, 0.1)));
    const Hull<double> hull = flat_hull_of(points);
    const double tolerance = 4 * hull_tolerance(points);
    expect_flat(hull, tolerance);
    Points directions = on_sphere(random, 50);
    for (Vec3d& direction : directions) direction.normalize();
    EXPECT_LT(support_error(hull, points, directions), tolerance) << i;
    for (const Vec3d& vertex : hull.vertices)
      EXPECT_NE(std::ranges::find(points, vertex), points.end()) << "coordinates are kept";
  }
}

TEST(FlatHull, HasTheCentroidOfItsArea) {
  // An L of points makes a pentagon: the square of two metres minus its upper right corner.
  const Hull<double> hull = flat_hull_of(
      {{0, 5, 0}, {2, 5, 0}, {2, 5, 1}, {1, 5, 1}, {1, 5, 2}, {0, 5, 2}, {0.5, 5, 0.5}});
  EXPECT_EQ(hull.vertex_count(), 5);
  // 4 m^2 at (1, 1) without the triangle of 0.5 m^2 at (5/3, 5/3).
  const double middle = (4 * 1 - 0.5 * 5 / 3) / 3.5;
  EXPECT_LT((hull.centroid - Vec3d(middle, 5, middle)).norm(), 1e-14);
  EXPECT_NEAR(hull.radius, std::hypot(2 - middle, middle), 1e-14);
}

TEST(FlatHull, LeavesOutPointsOnTheLineBetweenCorners) {
  Generator random(3);
  Points grid;
  for (int x = 0; x < 9; ++x)
    for (int z = 0; z < 7; ++z) grid.emplace_back(0.1 * x, 0, 0.1 * z);
  EXPECT_EQ(flat_hull_of(grid).vertex_count(), 4);
  for (int i = 0; i < 50; ++i) {
    const Points turned =
        rounded_to_float(transformed(grid, random_rotation(random), 1, Vec3d(0.1, 0.2, 0.3)));
    EXPECT_EQ(flat_hull_of(turned).vertex_count(), 4) << i;
  }
}

TEST(FlatHull, ThreePointsAreATriangle) {
  const Hull<double> hull = flat_hull_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  expect_flat(hull, 0);
  EXPECT_EQ(hull.vertex_count(), 3);
  EXPECT_LT((hull.centroid - Vec3d(1.0 / 3, 1.0 / 3, 0)).norm(), 1e-15);
}

TEST(FlatHull, SolidsAreTheSameWhetherOrNotFlatOnesAreAllowed) {
  Generator random(4);
  for (int i = 0; i < 20; ++i) {
    const Points points = in_ball(random, 4 + i);
    const Hull<double> hull = flat_hull_of(points);
    EXPECT_TRUE(is_sound(hull));
    EXPECT_EQ(hull.vertices, build_hull(points).vertices);
  }
}

TEST(FlatHullRefuses, NonPolygons) {
  const auto refusal = [](const Points& points) -> std::string {
    try {
      build_hull(points, {.weld_duplicates = true, .allow_flat = true});
    } catch (const ShapeError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal({{0, 0, 0}, {1, 0, 0}}), HasSubstr("at least three points, got 2"));
  EXPECT_THAT(refusal({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}), HasSubstr("needs at least three"));
  EXPECT_THAT(refusal({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), HasSubstr("of one line"));
  EXPECT_THAT(refusal({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 1e-9, 0}}), HasSubstr("of one line"));
  Points round = prism(129);
  for (Vec3d& point : round) point.y() = 0;
  EXPECT_THAT(refusal(round), HasSubstr("129 vertices"));
}

}  // namespace
}  // namespace contactscope::test
