#include "geometry/predicates.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "support/exact_integer.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::ExactInteger;
using test::Random;
using ExactPoint = std::array<ExactInteger, 3>;

/// Points as integers on one grid.
std::vector<ExactPoint> exact_points(const std::vector<Vec3d>& points) {
  std::vector<double> numbers;
  for (const Vec3d& point : points) numbers.insert(numbers.end(), point.begin(), point.end());
  const int exponent = test::common_exponent(numbers);
  return mapped(points, [&](const Vec3d& point) {
    return ExactPoint{ExactInteger::of(point.x(), exponent), ExactInteger::of(point.y(), exponent),
                      ExactInteger::of(point.z(), exponent)};
  });
}

/// Determinants of points with a column of ones, expanded along it: nothing is subtracted first.
ExactInteger det2(const ExactInteger& a, const ExactInteger& b, const ExactInteger& c,
                  const ExactInteger& d) {
  return a * d - b * c;
}
ExactInteger det3(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  return a[0] * det2(b[1], b[2], c[1], c[2]) - a[1] * det2(b[0], b[2], c[0], c[2]) +
         a[2] * det2(b[0], b[1], c[0], c[1]);
}
int oracle_3d(const std::vector<Vec3d>& points) {
  const std::vector<ExactPoint> p = exact_points(points);
  return (det3(p[1], p[2], p[3]) - det3(p[0], p[2], p[3]) + det3(p[0], p[1], p[3]) -
          det3(p[0], p[1], p[2]))
      .sign();
}
int oracle_2d(const std::vector<Vec3d>& points, int axis) {
  const std::vector<ExactPoint> p = exact_points(points);
  const auto x = static_cast<std::size_t>((axis + 1) % 3),
             y = static_cast<std::size_t>((axis + 2) % 3);
  return (det2(p[1][x], p[1][y], p[2][x], p[2][y]) - det2(p[0][x], p[0][y], p[2][x], p[2][y]) +
          det2(p[0][x], p[0][y], p[1][x], p[1][y]))
      .sign();
}

int orient_four(const std::vector<Vec3d>& p) { return orient3d(p[0], p[1], p[2], p[3]); }

Vec3d random_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// Moved by up to `steps` last bits up or down.
double nudged(Random& random, double value, int steps) {
  const double far = random.chance(0.5) ? 1e300 : -1e300;
  for (int i = random.index(steps + 1); i > 0; --i) value = std::nextafter(value, far);
  return value;
}
Vec3d nudged(Random& random, const Vec3d& point, int steps) {
  return {nudged(random, point.x(), steps), nudged(random, point.y(), steps),
          nudged(random, point.z(), steps)};
}

/// Four points; the last is on the plane, or the line, of others up to its rounding.
std::vector<Vec3d> nearly_flat(Random& random, double size, double from_origin, bool in_float) {
  const Vec3d center = from_origin * random.unit_vector();
  std::vector<Vec3d> points;
  for (int i = 0; i < 3; ++i) points.push_back(center + random_point(random, size));
  const double s = random.uniform(-1, 2), t = random.chance(0.3) ? 0.0 : random.uniform(-1, 2);
  points.push_back(points[0] + s * (points[1] - points[0]) + t * (points[2] - points[0]));
  if (random.chance(0.2)) points[2] = 0.5 * (points[0] + points[1]);
  if (random.chance(0.1)) points[3] = points[static_cast<std::size_t>(random.index(3))];
  if (in_float)
    for (Vec3d& point : points) point = point.cast<float>().cast<double>();
  points[3] = nudged(random, points[3], 2);
  return points;
}

TEST(Predicates, TheFrontIsWhereATriangleRunsCounterClockwise) {
  const Vec3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_EQ(orient3d(a, b, c, Vec3d(0, 0, 1)), 1);
  EXPECT_EQ(orient3d(a, b, c, Vec3d(0, 0, -1)), -1);
  EXPECT_EQ(orient3d(a, b, c, Vec3d(7, -9, 0)), 0);
  EXPECT_EQ(orient2d(a, b, c, 2), 1);
  EXPECT_EQ(orient2d(a, c, b, 2), -1);
  EXPECT_EQ(orient2d(a, b, b, 2), 0);
  EXPECT_EQ(orient2d(Vec3d(0, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1), 0), 1);
  EXPECT_EQ(orient2d(Vec3d(0, 0, 0), Vec3d(0, 0, 1), Vec3d(1, 0, 0), 1), 1);
}

TEST(Predicates, OneLastBitTurnsThePlane) {
  const double one = 1 + 0x1p-52;
  EXPECT_EQ(orient3d(Vec3d(0, 0, 0), Vec3d(1, 0, 1), Vec3d(0, 1, 1), Vec3d(1, 1, 2)), 0);
  EXPECT_EQ(orient3d(Vec3d(0, 0, 0), Vec3d(1, 0, 1), Vec3d(0, 1, one), Vec3d(1, 1, 2)), -1);
  EXPECT_EQ(orient3d(Vec3d(0, 0, 0), Vec3d(1, 0, 1), Vec3d(0, 1, 2 - one), Vec3d(1, 1, 2)), 1);
}

TEST(Predicates, OracleKnowsItsArithmetic) {
  const ExactInteger three = 3, big = ExactInteger::of(0x1.8p200, 0);
  EXPECT_EQ((big * big - three * three * ExactInteger::of(0x1p398, 0)).sign(), 0);
  EXPECT_EQ((big - ExactInteger(1) - big).to_double(), -1);
  EXPECT_EQ(ExactInteger::of(-0.375, -5).to_double(), -12);
  EXPECT_EQ((ExactInteger(-7) * ExactInteger(1LL << 40)).to_double(), -7 * 0x1p40);
}

/// The count of each sign shows that near-degenerate input really has all three.
void agrees_with_oracle(const std::vector<double>& sizes, double far, bool in_float, int count) {
  Random random(in_float ? 5 : 6);
  std::array<int, 3> signs{};
  for (int i = 0; i < count; ++i) {
    const double size = at(sizes, random.index(count_of(sizes)));
    const std::vector<Vec3d> points =
        nearly_flat(random, size, random.chance(0.5) ? 0 : far * size, in_float);
    const int expected = oracle_3d(points);
    ++at(signs, expected + 1);
    ASSERT_EQ(orient_four(points), expected) << i;
    const double value = orient3d_value(points[0], points[1], points[2], points[3]);
    ASSERT_EQ(predicates::sign_of(value), expected) << i;
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(orient2d(points[0], points[1], points[3], axis),
                oracle_2d({points[0], points[1], points[3]}, axis))
          << i;
    }
  }
  for (const int of_sign : signs) EXPECT_GT(of_sign, count / 50);
}

TEST(Predicates, SlowSignsOfNearlyFlatDoublesAreExact) {
  agrees_with_oracle({1e-70, 1e-4, 1, 1e4, 1e90}, 1e3, false, 20000);
}

TEST(Predicates, SlowSignsOfNearlyFlatFloatsAreExact) {
  agrees_with_oracle({1e-38, 1e-4, 1, 1e4, 1e30}, 1e3, true, 20000);
}

TEST(Predicates, SubnormalFloatsAreExact) {
  Random random(9);
  const double least = std::numeric_limits<float>::denorm_min();
  for (int i = 0; i < 2000; ++i) {
    std::vector<Vec3d> points;
    for (int k = 0; k < 4; ++k)
      points.push_back(least * Vec3d(random.index(4), random.index(4), random.index(4)));
    if (random.chance(0.3)) points[0] = Vec3d(3e38, 0, 0);
    ASSERT_EQ(orient_four(points), oracle_3d(points));
  }
}

TEST(Predicates, SlowMixedMagnitudesAreExact) {
  Random random(10);
  for (int i = 0; i < 20000; ++i) {
    std::vector<Vec3d> points;
    for (int k = 0; k < 4; ++k) {
      points.emplace_back(Vec3d::Zero());
      for (double& number : points.back())
        number = random.chance(0.2) ? 0.0 : random.uniform(-1, 1) * random.decade(-70, 70);
    }
    if (random.chance(0.5)) points[3] = 0.5 * points[0] + 0.5 * points[1];
    ASSERT_EQ(orient_four(points), oracle_3d(points)) << i;
  }
}

TEST(Predicates, EverySwapTurnsTheSign) {
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const std::vector<Vec3d> p = nearly_flat(random, 1, 10, random.chance(0.5));
    const int sign = orient_four(p);
    EXPECT_EQ(orient3d(p[1], p[0], p[2], p[3]), -sign);
    EXPECT_EQ(orient3d(p[0], p[2], p[1], p[3]), -sign);
    EXPECT_EQ(orient3d(p[0], p[1], p[3], p[2]), -sign);
    EXPECT_EQ(orient3d(p[3], p[0], p[1], p[2]), -sign);
  }
}

TEST(Predicates, SlowValuesAreRelativelyAccurate) {
  // Compared with the determinant in exact integers, for points on a grid of 2^-60.
  Random random(12);
  for (int i = 0; i < 5000; ++i) {
    const std::vector<Vec3d> points = nearly_flat(random, 1, 0, random.chance(0.5));
    const std::vector<ExactPoint> p = exact_points(points);
    std::vector<double> numbers;
    for (const Vec3d& point : points) numbers.insert(numbers.end(), point.begin(), point.end());
    const double exact = std::ldexp((det3(p[1], p[2], p[3]) - det3(p[0], p[2], p[3]) +
                                     det3(p[0], p[1], p[3]) - det3(p[0], p[1], p[2]))
                                        .to_double(),
                                    3 * test::common_exponent(numbers));
    const double value = orient3d_value(points[0], points[1], points[2], points[3]);
    ASSERT_NEAR(value, exact, 0x1p-32 * std::abs(exact)) << i;
  }
}

}  // namespace
}  // namespace contactscope
