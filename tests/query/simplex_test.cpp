#include "query/gjk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Random;
using Points = std::array<Vec3d, 4>;

NearestOnSimplex<double> nearest(const Points& points, int count, double scale = 10) {
  NearestOnSimplex<double> result;
  nearest_on_simplex(points, count, scale, result);
  return result;
}

/// The weights and the kept points reproduce the nearest point.
void expect_consistent(const Points& points, const NearestOnSimplex<double>& result) {
  Vec3d sum = Vec3d::Zero();
  double weights = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(result.count); ++i) {
    EXPECT_GT(result.weights[i], 0);
    weights += result.weights[i];
    sum += result.weights[i] * points[static_cast<std::size_t>(result.kept[i])];
  }
  EXPECT_NEAR(weights, 1, 1e-14);
  EXPECT_LE((sum - result.point).norm(), 1e-13);
  EXPECT_NEAR(result.squared_distance, result.point.squaredNorm(), 1e-15);
}

TEST(Simplex, OriginBeforeTheFaceEdgeAndCornerOfATriangle) {
  const auto shifted = [](const Vec3d& origin) {
    return Points{Vec3d(0, 0, 0) - origin, Vec3d(4, 0, 0) - origin, Vec3d(0, 4, 0) - origin, {}};
  };
  const NearestOnSimplex<double> face = nearest(shifted({1, 1, 2}), 3);
  EXPECT_EQ(face.count, 3);
  EXPECT_EQ(face.point, Vec3d(0, 0, -2));
  EXPECT_EQ(face.weights[0], 0.5);
  EXPECT_EQ(face.weights[1], 0.25);
  EXPECT_EQ(face.weights[2], 0.25);

  const NearestOnSimplex<double> edge = nearest(shifted({-3, 1, 4}), 3);
  EXPECT_EQ(edge.count, 2);
  EXPECT_EQ(edge.kept[0], 0);
  EXPECT_EQ(edge.kept[1], 2);
  EXPECT_EQ(edge.weights[1], 0.25);
  EXPECT_EQ(edge.squared_distance, 25);

  const NearestOnSimplex<double> corner = nearest(shifted({-1, 6, 2}), 3);
  EXPECT_EQ(corner.count, 1);
  EXPECT_EQ(corner.kept[0], 2);
  EXPECT_EQ(corner.squared_distance, 9);
}

TEST(Simplex, WeightsInsideATetrahedronMakeTheOrigin) {
  Random random(1);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    Points points;
    for (Vec3d& point : points) point = random.unit_vector();
    const NearestOnSimplex<double> result = nearest(points, 4);
    if (result.count != 4) continue;
    expect_consistent(points, result);
    ++inside;
  }
  EXPECT_GT(inside, 100);  // an eighth of them
}

/// Puts each point last in turn. Every face contains one of the points, so all faces are examined.
double distance_with_any_last(const Points& points, int count) {
  double squared = std::numeric_limits<double>::infinity();
  for (int last = 0; last < count; ++last) {
    Points turned = points;
    std::swap(turned[static_cast<std::size_t>(last)], turned[static_cast<std::size_t>(count - 1)]);
    const NearestOnSimplex<double> result = nearest(turned, count);
    EXPECT_LT(result.count, 4);
    expect_consistent(turned, result);
    squared = std::min(squared, result.squared_distance);
  }
  return std::sqrt(squared);
}

/// Away from the origin, down to plates without thickness.
TEST(Simplex, NoSampleOfASimplexIsNearer) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double thickness = random.chance(0.5) ? 1 : random.decade(-17, 0);
    const Quatd turn = random.rotation();
    Points points;
    for (Vec3d& point : points) {
      const Vec3d flat = random.unit_vector().cwiseProduct(Vec3d(1, 1, thickness));
      point = Vec3d(0, 0, 1.5) + turn * flat;
    }
    for (int count = 1; count <= 4; ++count) {
      const double distance = distance_with_any_last(points, count);
      for (int sample = 0; sample < 20; ++sample) {
        Vec3d point = Vec3d::Zero();
        double sum = 0;
        for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
          const double weight = random.uniform(0, 1);
          point += weight * points[k];
          sum += weight;
        }
        EXPECT_GE((point / sum).norm(), distance - 4e-15);
      }
    }
  }
}

TEST(Simplex, CoincidentAndCollinearPointsHaveANearestOne) {
  const Vec3d p(1, 2, 2);
  const NearestOnSimplex<double> same = nearest({p, p, p, p}, 4);
  EXPECT_EQ(same.count, 1);
  EXPECT_EQ(same.squared_distance, 9);

  const Points line{Vec3d(-2, 3, 0), Vec3d(6, 3, 0), Vec3d(2, 3, 0), Vec3d(-1, 3, 0)};
  for (int count = 2; count <= 4; ++count) {
    const NearestOnSimplex<double> result = nearest(line, count);
    EXPECT_EQ(result.count, 2);
    EXPECT_EQ(result.squared_distance, 9);
    expect_consistent(line, result);
  }
}

TEST(Simplex, NormalOfANearTriangleIsFreeOfTheRoundingOfItsPoint) {
  const Vec3d normal = Vec3d(1, 2, 3).normalized();
  const Vec3d side = any_perpendicular(normal);
  const Vec3d other = normal.cross(side);
  const double height = 1e-14;
  const Points points{
      height * normal + side, height * normal - side + other, height * normal - side - other, {}};
  const NearestOnSimplex<double> result = nearest(points, 3);
  EXPECT_EQ(result.count, 3);
  EXPECT_LE((result.direction.normalized() - normal).norm(), 1e-14);
  EXPECT_GT(result.direction.dot(normal), 0);
}

}  // namespace
}  // namespace contactscope
