#include "reduce/reducer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/random_geometry.h"

namespace contactscope {
namespace {

double triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& normal) {
  return 0.5 * std::abs(Vec3d(b - a).cross(Vec3d(c - a)).dot(normal));
}

/// Tries every three points.
double brute_force_three(const std::vector<Vec3d>& p, const Vec3d& normal) {
  double best = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) best = std::max(best, triangle(p[i], p[j], p[k], normal));
  return best;
}

/// Tries every diagonal with a point on each side of it.
double brute_force_four(const std::vector<Vec3d>& p, const Vec3d& normal) {
  double best = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      double left = 0;
      double right = 0;
      for (const Vec3d& q : p) {
        const double side = 0.5 * Vec3d(p[j] - p[i]).cross(Vec3d(q - p[i])).dot(normal);
        left = std::max(left, side);
        right = std::max(right, -side);
      }
      best = std::max(best, left + right);
    }
  }
  return best;
}

std::vector<Vec3d> random_points(test::Random& random, int count, const Quatd& turn,
                                 const Vec3d& centre) {
  std::vector<Vec3d> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(centre + turn * Vec3d(random.uniform(-1, 1), 0, random.uniform(-1, 1)));
  }
  return points;
}

TEST(PolygonArea, UnitSquareWithPointsInsideAndOnEdges) {
  const std::vector<Vec3d> points = {{0, 0, 0},   {1, 0, 0},     {1, 0, 1}, {0, 0, 1},
                                     {0.5, 0, 0}, {0.5, 0, 0.5}, {1, 0, 1}, {0.2, 0, 0.9}};
  EXPECT_NEAR(convex_area(points, Vec3d::UnitY()), 1, 1e-15);
  EXPECT_NEAR(convex_area(points, -Vec3d::UnitY()), 1, 1e-15);
  EXPECT_NEAR(best_convex_area(points, Vec3d::UnitY(), 4), 1, 1e-15);
  EXPECT_NEAR(best_convex_area(points, Vec3d::UnitY(), 3), 0.5, 1e-15);
  EXPECT_EQ(best_convex_area(points, Vec3d::UnitY(), 2), 0);
  EXPECT_EQ(best_convex_area(points, Vec3d::UnitY(), 1), 0);
}

TEST(PolygonArea, DegenerateInputsHaveNone) {
  const Vec3d up = Vec3d::UnitY();
  EXPECT_EQ(convex_area({}, up), 0);
  EXPECT_EQ(best_convex_area({}, up, 4), 0);
  EXPECT_EQ(convex_area(std::vector<Vec3d>(1, Vec3d(1, 2, 3)), up), 0);
  EXPECT_EQ(convex_area(std::vector<Vec3d>(5, Vec3d(1, 2, 3)), up), 0);
  const std::vector<Vec3d> line = {{0, 0, 0}, {1, 0, 1}, {2, 0, 2}, {3, 0, 3}};
  EXPECT_NEAR(convex_area(line, up), 0, 1e-15);
  EXPECT_NEAR(best_convex_area(line, up, 3), 0, 1e-15);
}

TEST(PolygonArea, SlowBestTriangleAndQuadrilateralAgreeWithBruteForce) {
  test::Random random(3);
  for (int i = 0; i < 300; ++i) {
    const Quatd turn = random.rotation();
    const Vec3d normal = turn * Vec3d::UnitY();
    const std::vector<Vec3d> points =
        random_points(random, 3 + random.index(14), turn, 10 * random.unit_vector());
    EXPECT_NEAR(best_convex_area(points, normal, 3), brute_force_three(points, normal), 1e-12);
    EXPECT_NEAR(best_convex_area(points, normal, 4), brute_force_four(points, normal), 1e-12);
  }
}

TEST(PolygonArea, RegularPolygonOfManyCorners) {
  std::vector<Vec3d> points;
  for (int i = 0; i < 24; ++i) {
    const double angle = i * std::numbers::pi / 12;
    points.emplace_back(std::cos(angle), std::sin(angle), 4);
  }
  const auto regular = [](int n) { return 0.5 * n * std::sin(2 * std::numbers::pi / n); };
  for (const int corners : {3, 4, 6, 8, 12, 24, 100}) {
    EXPECT_NEAR(best_convex_area(points, Vec3d::UnitZ(), corners), regular(std::min(corners, 24)),
                1e-12)
        << corners;
  }
}

}  // namespace
}  // namespace contactscope
