#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "reduce/plane_points.h"
#include "reduce/reducer.h"
#include "support/random_geometry.h"

// The talk's alternatives, and bad choices for comparison.
namespace contactscope {
namespace {

using test::kept_by;
using test::PlanePoint;
using test::points_at;
using testing::Contains;
using testing::ElementsAre;
using testing::Not;
using testing::UnorderedElementsAre;

template <class S>
double area_of(const std::vector<ContactPoint<S>>& points, const std::vector<int>& kept) {
  std::vector<Vec3d> chosen;
  for (const int i : kept) {
    chosen.push_back(points[static_cast<std::size_t>(i)].position.template cast<double>());
  }
  return convex_area(chosen, Vec3d::UnitY());
}

template <class S> class SimpleReducers : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SimpleReducers, Scalars);

TYPED_TEST(SimpleReducers, DistancePrefersAShortEdgeWhereAreaPrefersALongOne) {
  // After the triangle 1 0 2, point 3 is farther from its edge (the short one, 1 2); point 4 is
  // less far from a longer one. Gregorius 2015, "Contact Point Reduction: 4th Point (6)".
  const auto points = points_at<TypeParam>({{-10, 0}, {10, 0}, {9, -4}, {11.5, -2}, {0, 1}});
  EXPECT_THAT(kept_by("distance", points), ElementsAre(1, 0, 2, 3));
  EXPECT_THAT(kept_by("area", points), ElementsAre(1, 0, 2, 4));
  EXPECT_LT(area_of(points, {1, 0, 2, 3}), area_of(points, {1, 0, 2, 4}));
}

TYPED_TEST(SimpleReducers, ExtremesLoseADiamondThatLiesAcrossTheAxes) {
  for (const double degrees : {0.0, 30.0, 45.0, 60.0, 90.0}) {
    SCOPED_TRACE(degrees);
    const double turn = degrees * std::numbers::pi / 180;
    const auto turned = [&](double x, double z) {
      return PlanePoint{x * std::cos(turn) - z * std::sin(turn),
                        x * std::sin(turn) + z * std::cos(turn)};
    };
    const auto points = points_at<TypeParam>(
        {turned(0, 0), turned(10, 0), turned(0, 1), turned(-10, 0), turned(0, -1)});
    const double kept = area_of(points, kept_by("extremes", points));
    EXPECT_NEAR(kept, std::fmod(degrees, 90) == 0 ? 20 : 0, 1e-5);
    EXPECT_NEAR(area_of(points, kept_by("area", points)), 20, 1e-5);
  }
}

TYPED_TEST(SimpleReducers, ExtremesAreLowestAndHighestAlongBothAxes) {
  const auto points =
      points_at<TypeParam>({{0, 0}, {5, 1}, {1, 7}, {3, 3}, {-2, 2}, {1, -6}, {4, 2}});
  EXPECT_THAT(kept_by("extremes", points), UnorderedElementsAre(1, 2, 4, 5));
}

TYPED_TEST(SimpleReducers, DeepestGoByDepthThenByIndex) {
  const auto points = points_at<TypeParam>(
      {{0, 0, 0.1}, {1, 0, 0.5}, {2, 0, 0.2}, {2, 1, 0.5}, {2, 2, -0.3}, {1, 2, 0.4}, {0, 2, 0.2}});
  EXPECT_THAT(kept_by("deepest", points), ElementsAre(1, 3, 5, 2));
  EXPECT_THAT(kept_by("deepest", points, 1), ElementsAre(1));
  EXPECT_THAT(kept_by("deepest", points, 6), ElementsAre(1, 3, 5, 2, 6, 0));
}

TYPED_TEST(SimpleReducers, DeepestJumpWhereDepthsCross) {
  // A micrometre of tilt replaces half of the manifold. Area ignores depth.
  const auto tilted = [](double tilt) {
    return points_at<TypeParam>({{-1, -1, 0.01},
                                 {1, -1, 0.01},
                                 {1, 1, 0.01 + tilt},
                                 {-1, 1, 0.01 + tilt},
                                 {0, -1.2, 0.01},
                                 {0, 1.2, 0.01 + tilt}});
  };
  const auto before = kept_by("deepest", tilted(-1e-6));
  const auto after = kept_by("deepest", tilted(1e-6));
  EXPECT_THAT(before, ElementsAre(0, 1, 4, 2));
  EXPECT_THAT(after, ElementsAre(2, 3, 5, 0));
  EXPECT_EQ(kept_by("area", tilted(-1e-6)), kept_by("area", tilted(1e-6)));
}

TYPED_TEST(SimpleReducers, FirstKeepTheOrder) {
  const auto points = points_at<TypeParam>({{0, 0}, {0, 0}, {1, 2}, {5, 5}, {9, 9}, {1, 1}});
  EXPECT_THAT(kept_by("first", points), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(kept_by("first", points, 2), ElementsAre(0, 1));
  EXPECT_THAT(kept_by("first", points, 5), ElementsAre(0, 1, 2, 3, 4));
}

TYPED_TEST(SimpleReducers, RandomChoosesTheSameOnEveryPlatform) {
  // Computed by another program from the same published generator.
  const auto points = points_at<TypeParam>(std::vector<PlanePoint>(8));
  const auto chosen = [&](std::uint64_t seed) {
    ReduceOptions options;
    options.seed = seed;
    return kept_by("random", points, options);
  };
  EXPECT_THAT(chosen(0), ElementsAre(7, 4, 2, 0));
  EXPECT_THAT(chosen(1), ElementsAre(4, 6, 7, 5));
  EXPECT_THAT(chosen(2), ElementsAre(4, 6, 5, 1));
  EXPECT_THAT(chosen(std::numeric_limits<std::uint64_t>::max()), ElementsAre(7, 0, 3, 5));
}

TYPED_TEST(SimpleReducers, RandomChoosesEveryPointAsOften) {
  const auto points = points_at<TypeParam>(std::vector<PlanePoint>(8));
  std::array<int, 8> times = {};
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    ReduceOptions options;
    options.seed = seed;
    for (const int i : kept_by("random", points, options)) ++times[static_cast<std::size_t>(i)];
  }
  // Half of 4000, within five standard deviations of sqrt(4000) / 2.
  EXPECT_THAT(times, testing::Each(testing::AllOf(testing::Gt(1842), testing::Lt(2158))));
}

TYPED_TEST(SimpleReducers, AreaFromTheDeepestKeepsAPointThatAreaDrops) {
  // A square with a deep point in its middle. The farthest from it is the first corner; then follow
  // the two on the other diagonal. One corner gets lost.
  const auto points = points_at<TypeParam>(
      {{1, 1, 0.01}, {-1, 1, 0.01}, {-1, -1, 0.01}, {1, -1, 0.01}, {0.125, 0, 0.02}});
  EXPECT_THAT(kept_by("area", points), Not(Contains(4)));
  EXPECT_THAT(kept_by("area_deepest", points), ElementsAre(4, 1, 2, 0));
}

TYPED_TEST(SimpleReducers, AreaFromTheDeepestKeepsItWhereverItLies) {
  test::Random random(4);
  for (int i = 0; i < 500; ++i) {
    std::vector<PlanePoint> places;
    const int count = 2 + random.index(15);
    for (int k = 0; k < count; ++k) {
      places.push_back({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0, 1)});
    }
    const auto deepest = std::ranges::max_element(places, {}, &PlanePoint::depth);
    const auto points = points_at<TypeParam>(places);
    EXPECT_THAT(kept_by("area_deepest", points, 1),
                ElementsAre(static_cast<int>(deepest - places.begin())));
    EXPECT_THAT(kept_by("area_deepest", points),
                Contains(static_cast<int>(deepest - places.begin())));
  }
}

TYPED_TEST(SimpleReducers, AreaFromTheDeepestKeepsBothEndsOfALineAsWell) {
  const auto points =
      points_at<TypeParam>({{0.25, 0.25}, {-1, -1}, {0, 0, 0.5}, {2, 2}, {1, 1}, {-0.5, -0.5}});
  EXPECT_THAT(kept_by("area_deepest", points), ElementsAre(2, 3, 1));
  EXPECT_THAT(kept_by("area_deepest", points, 2), ElementsAre(2, 3));
}

}  // namespace
}  // namespace contactscope
