#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "geometry/hull_builder.h"
#include "query/penetration.h"
#include "query/sat.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"
#include "support/cases.h"
#include "support/random_geometry.h"

// Hulls with nearly coincident vertices. Their edges are short, so an error that is small compared
// with the hull turns them; an edge pair that is no support then reports too little depth.
namespace contactscope {
namespace {

using test::Random;

/// The hull that a scenario with this scalar builds.
template <class S> Hull<S> hull_of(const std::vector<Vec3d>& points) {
  HullOptions options{.for_float = std::is_same_v<S, float>};
  if (!options.for_float) options.epsilon = epsilon_of_digits(points);
  return hull_cast<S>(build_hull(points, options));
}

/// Coordinates rounded to this scalar.
template <class S> std::vector<Vec3d> rounded(std::vector<Vec3d> points) {
  for (Vec3d& point : points) {
    for (double& x : point) {
      const volatile S kept = static_cast<S>(x);
      x = static_cast<double>(kept);
    }
  }
  return points;
}

/// Both separations in metres, negative in overlap.
struct Depths {
  double by_sat, by_query, right, rounding;
};

template <class S>
Depths depths_of(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b,
                 const Pose<double>& b_in_a) {
  const Hull<S> hull_a = hull_of<S>(a), hull_b = hull_of<S>(b);
  const Pose<S> pose = b_in_a.cast<S>();
  const HullPair<S> pair(hull_a, hull_b, pose);
  const SatResult<S> axes = sat(pair, std::numeric_limits<S>::max(), Preference::None);
  const auto requested = penetration<S>(PenetrationMethod::Sat, support_set(hull_a),
                                        support_set(hull_b), pose, {}, nullptr, nullptr);
  Pose<double> exact{pose.rotation.template cast<double>(), pose.position.template cast<double>()};
  exact.rotation.normalize();
  return {static_cast<double>(axes.separation(axes.chosen)), -static_cast<double>(requested.depth),
          test::brute_force_sat(rounded<S>(a), rounded<S>(b), exact).separation,
          64 * static_cast<double>(std::numeric_limits<S>::epsilon() * pair.scale)};
}

/// Up to eight points in a box, on a lattice or on a sphere, of 10 m, and up to three more, each
/// near one of them: 1e-2 to 1e-9 of 5 m away.
std::vector<Vec3d> near_points(Random& random) {
  std::vector<Vec3d> points;
  const int style = random.index(3);
  const int count = style == 1 ? 8 : 4 + random.index(5);
  for (int i = 0; i < count; ++i) {
    Vec3d point = random.vector(-5, 5);
    if (style == 1) point = point.array().round();
    if (style == 2) point = 5 * point.normalized();
    if (std::ranges::find(points, point) == points.end()) points.push_back(point);
  }
  for (int more = 1 + random.index(3); more > 0; --more) {
    const Vec3d center = points[static_cast<std::size_t>(random.index(count_of(points)))];
    const double distance = 5 * random.decade(-9, -2);
    points.push_back(center + distance * random.unit_vector());
  }
  return points;
}

template <class S> class NearPoints : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(NearPoints, Scalars);

TYPED_TEST(NearPoints, TwoVerticesOfATipGiveTheDepthOfEveryAxis) {
  const std::vector<Vec3d> a = {{3.102923, 3.7408961, -1.306666},
                                {3.1029373, 3.7408876, -1.306672},
                                {-5.0, 1.4, -3.5},
                                {0.0, -6.0, 6.0},
                                {-1.0, -3.0, 1.0}};
  const std::vector<Vec3d> b = {{2.0, -2.0, -5.0}, {-4.0, -6.0, -12.0}, {5.0, -11.0, 3.0},
                                {-4.0, 7.0, -4.0}, {1.0, -3.0, -2.0},   {8.0, 0.0, 6.0},
                                {13.0, -3.0, -8.0}};
  const Depths depths = depths_of<TypeParam>(a, b, {});
  EXPECT_NEAR(depths.right, -2.104, 5e-4);
  EXPECT_NEAR(depths.by_sat, depths.right, depths.rounding);
  EXPECT_NEAR(depths.by_query, depths.right, depths.rounding);
}

TYPED_TEST(NearPoints, SlowDepthsAreWithin64RoundingsOfEveryAxis) {
  Random random(34);
  int overlapping = 0;
  for (int i = 0; overlapping < test::cases(4'000); ++i) {
    SCOPED_TRACE("pair " + std::to_string(i));
    const std::vector<Vec3d> a = near_points(random), b = near_points(random);
    Pose<double> b_in_a{random.rotation(), random.vector(-4, 4)};
    if (random.chance(0.3)) b_in_a.rotation = Quatd::Identity();
    const Depths depths = depths_of<TypeParam>(a, b, b_in_a);
    if (depths.right > -depths.rounding) continue;
    ++overlapping;
    ASSERT_NEAR(depths.by_sat, depths.right, depths.rounding);
    ASSERT_NEAR(depths.by_query, depths.right, depths.rounding);
  }
}

// Coordinates in a file have seven digits or fewer: those of floats, or written by hand. Faces that
// such digits bend are one face, so depths are right within 64 roundings of seven digits.
TEST(NearPointsOfSevenDigits, SlowDepthsAreWithin64RoundingsOfTheDigits) {
  Random random(35);
  const auto written = [](std::vector<Vec3d> points) {
    for (Vec3d& point : points)
      for (double& x : point) {
        char text[32];
        std::snprintf(text, sizeof text, "%.7g", x);
        x = std::atof(text);
      }
    return points;
  };
  int overlapping = 0;
  for (int i = 0; overlapping < test::cases(2'000); ++i) {
    SCOPED_TRACE("pair " + std::to_string(i));
    const std::vector<Vec3d> a = written(near_points(random)), b = written(near_points(random));
    const Pose<double> b_in_a{random.rotation(), random.vector(-4, 4)};
    Depths depths;
    try {
      depths = depths_of<double>(a, b, b_in_a);
    } catch (const ShapeError&) {
      continue;  // within seven digits all points are in one plane
    }
    const double rounding =
        depths.rounding / std::numeric_limits<double>::epsilon() * 0.5e-7;  // of the last digit
    if (depths.right > -rounding) continue;
    ++overlapping;
    ASSERT_NEAR(depths.by_sat, depths.right, rounding);
    ASSERT_NEAR(depths.by_query, depths.right, rounding);
  }
}

}  // namespace
}  // namespace contactscope
