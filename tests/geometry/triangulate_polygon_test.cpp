#include "geometry/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/random_geometry.h"

namespace contactscope::test {
namespace {

using Polygon = std::vector<Vec3d>;

Vec3d area_vector(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d ab = b - a;
  const Vec3d ac = c - a;
  return 0.5 * ab.cross(ac);
}

/// The triangles have the polygon's orientation, do not overlap, and cover it: none is flat, and
/// their areas sum to the polygon's.
void expect_covered(const Polygon& polygon) {
  const std::vector<std::array<int, 3>> triangles = triangulate_polygon(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  Vec3d whole = Vec3d::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    whole += area_vector(polygon[0], polygon[i], polygon[i + 1]);
  }
  double sum = 0;
  for (const std::array<int, 3>& t : triangles) {
    const Vec3d area = area_vector(polygon.at(static_cast<std::size_t>(t[0])),
                                   polygon.at(static_cast<std::size_t>(t[1])),
                                   polygon.at(static_cast<std::size_t>(t[2])));
    sum += area.norm();
    EXPECT_GT(area.norm(), 1e-10 * whole.norm());
    EXPECT_GT(area.dot(whole), 0.99 * area.norm() * whole.norm());
  }
  EXPECT_NEAR(sum, whole.norm(), 1e-9 * whole.norm());
}

/// The same shape near and far, small and large, and turned: six digits remain in each.
void expect_covered_anywhere(Random& random, const Polygon& polygon) {
  expect_covered(polygon);
  for (int i = 0; i < 20; ++i) {
    const double scale = random.decade(-4, 4);
    Pose<double> pose = random.pose(0);
    pose.position = scale * random.decade(-2, 2) * random.unit_vector();
    Polygon placed;
    for (const Vec3d& corner : polygon) placed.push_back(pose.transform(scale * corner));
    expect_covered(placed);
    std::reverse(placed.begin(), placed.end());
    expect_covered(placed);
  }
}

/// Corners about the origin at rising angles and the given radii, in the x-y plane.
Polygon star(const std::vector<double>& radii) {
  Polygon polygon;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double turn =
        2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(radii.size());
    polygon.emplace_back(radii[i] * std::cos(turn), radii[i] * std::sin(turn), 0);
  }
  return polygon;
}

TEST(TriangulatePolygon, ATriangleIsItself) {
  const Polygon polygon{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(triangulate_polygon(polygon), (std::vector<std::array<int, 3>>{{0, 1, 2}}));
}

TEST(TriangulatePolygon, AQuadIsCutAlongItsShorterDiagonal) {
  const Polygon polygon{{-2, 0, 0}, {0, -1, 0}, {2, 0, 0}, {0, 1, 0}};
  for (const std::array<int, 3>& t : triangulate_polygon(polygon)) {
    EXPECT_NE(std::find(t.begin(), t.end(), 1), t.end());
    EXPECT_NE(std::find(t.begin(), t.end(), 3), t.end());
  }
}

TEST(TriangulatePolygon, AnArrowheadIsCutInside) {
  Random random(1);
  expect_covered_anywhere(random, {{0, 0, 0}, {3, 3, 0}, {0, 1, 0}, {-3, 3, 0}});
}

TEST(TriangulatePolygon, RegularPolygonsAreCovered) {
  Random random(2);
  for (const std::size_t corners : {4u, 5u, 6u, 12u, 100u}) {
    expect_covered_anywhere(random, star(std::vector<double>(corners, 1.0)));
  }
}

TEST(TriangulatePolygon, StarsWithDeepNotchesAreCovered) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    std::vector<double> radii;
    const int corners = 5 + random.index(40);
    for (int k = 0; k < corners; ++k) radii.push_back(random.uniform(0.1, 1));
    expect_covered_anywhere(random, star(radii));
  }
}

TEST(TriangulatePolygon, ACombIsCovered) {
  Random random(4);
  Polygon comb;
  for (int tooth = 0; tooth < 10; ++tooth) {
    comb.emplace_back(tooth, 0, 0);
    comb.emplace_back(tooth + 0.5, -5, 0);
  }
  comb.emplace_back(10, 0, 0);
  comb.emplace_back(10, 1, 0);
  comb.emplace_back(0, 1, 0);
  // After the teeth are cut, their ends lie on one line, up to rounding if the comb is turned.
  expect_covered_anywhere(random, comb);
}

TEST(TriangulatePolygon, CornersOnALineGiveNoFlatTriangle) {
  Random random(6);
  for (const Polygon& polygon :
       {Polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}},
        Polygon{
            {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}},
        Polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 5, 0}}}) {
    expect_covered_anywhere(random, polygon);
  }
}

TEST(TriangulatePolygon, SlowStaircasesOnALatticeGiveNoFlatTriangle) {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    // A skyline: columns of integer heights over a base; every lattice point on it is a corner.
    const int columns = 2 + random.index(6);
    std::vector<int> heights;
    for (int k = 0; k < columns; ++k) heights.push_back(1 + random.index(5));
    Polygon outline;
    for (int k = 0; k <= columns; ++k) outline.emplace_back(k, 0, 0);
    for (int k = columns; k-- > 0;) {
      const int from = k + 1 == columns ? 0 : heights[static_cast<std::size_t>(k) + 1];
      const int to = heights[static_cast<std::size_t>(k)];
      for (int y = from; y != to;) {
        y += to > from ? 1 : -1;
        outline.emplace_back(k + 1, y, 0);
      }
      outline.emplace_back(k, to, 0);
    }
    for (int y = heights[0] - 1; y > 0; --y) outline.emplace_back(0, y, 0);
    expect_covered_anywhere(random, outline);
  }
}

TEST(TriangulatePolygon, AHoleJoinedByADoubleEdgeStaysOpen) {
  expect_covered({{0, 0, 0},
                  {3, 0, 0},
                  {3, 3, 0},
                  {0, 3, 0},
                  {0, 0, 0},
                  {1, 1, 0},
                  {1, 2, 0},
                  {2, 2, 0},
                  {2, 1, 0},
                  {1, 1, 0}});
}

TEST(TriangulatePolygon, SelfCrossingOrZeroAreaStillGivesThatMany) {
  EXPECT_EQ(triangulate_polygon(Polygon{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2u);
  EXPECT_EQ(triangulate_polygon(Polygon(7, Vec3d(1, 2, 3))).size(), 5u);
  EXPECT_EQ(triangulate_polygon(star({1, -1, 1, -1, 1, -1, 1})).size(), 5u);
}

}  // namespace
}  // namespace contactscope::test
