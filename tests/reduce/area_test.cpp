#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reduce/brute_force.h"
#include "reduce/reducer.h"
#include "reduce/steps.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

/// Points in the x-z plane, y up.
template <class S>
std::vector<ContactPoint<S>> points_at(const std::vector<std::pair<double, double>>& places) {
  std::vector<ContactPoint<S>> points;
  for (const auto& [x, z] : places) {
    points.push_back({Vec3d(x, 0, z).cast<S>(), S(0), FeatureId{}});
  }
  return points;
}

template <class S>
std::vector<int> reduced(const std::vector<ContactPoint<S>>& points, int max_points) {
  ReduceOptions options;
  options.max_points = max_points;
  const KeptIndices kept = reduce<S>(find_reducer("area"), points, Vec3<S>::UnitY(), options);
  return {kept.begin(), kept.end()};
}

template <class S>
double area_of(const std::vector<ContactPoint<S>>& points, const std::vector<int>& kept) {
  std::vector<Vec3d> chosen;
  for (const int i : kept) {
    chosen.push_back(points[static_cast<std::size_t>(i)].position.template cast<double>());
  }
  return convex_area(chosen, Vec3d::UnitY());
}

template <class S> class AreaReducer : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(AreaReducer, Scalars);

TYPED_TEST(AreaReducer, KeepsTheCornersOfASquareAmongPointsInside) {
  const auto points = points_at<TypeParam>(
      {{0, 0}, {0.2, 0.1}, {1, 0}, {0.5, 0.5}, {1, 1}, {0.3, 0.8}, {0, 1}, {0.9, 0.5}});
  EXPECT_THAT(reduced(points, 4), UnorderedElementsAre(0, 2, 4, 6));
}

TYPED_TEST(AreaReducer, FollowsTheTalksOrderOfChoice) {
  // The support point of the fixed direction (x before z) is the far right corner. The farthest
  // from it is the left end. The largest triangle uses the point below; last comes the top.
  const auto points = points_at<TypeParam>({{-2, 0}, {0, 0.5}, {2, 0}, {0, -1}, {0.1, 0.1}});
  EXPECT_THAT(reduced(points, 4), ElementsAre(2, 0, 3, 1));
}

TYPED_TEST(AreaReducer, AddsTheLargestAreaNotTheLargestDistance) {
  // "Maximize area, not distance": after the triangle 1 0 2, point 3 is farther from its edge (the
  // short one, 1 2); point 4 is less far from a longer one.
  const auto points = points_at<TypeParam>({{-10, 0}, {10, 0}, {9, -4}, {11.5, -2}, {0, 1}});
  EXPECT_THAT(reduced(points, 4), ElementsAre(1, 0, 2, 4));
}

TYPED_TEST(AreaReducer, KeepsFewPointsInTheirOrder) {
  const auto points = points_at<TypeParam>({{3, 0}, {0, 0}, {1, 1}});
  EXPECT_THAT(reduced(points, 4), ElementsAre(0, 1, 2));
  EXPECT_THAT(reduced(points, 3), ElementsAre(0, 1, 2));
  EXPECT_THAT(reduced(points_at<TypeParam>({}), 4), ElementsAre());
}

TYPED_TEST(AreaReducer, HonoursEveryMaximum) {
  std::vector<std::pair<double, double>> circle;
  for (int i = 0; i < 16; ++i) {
    circle.emplace_back(std::cos(i * std::numbers::pi / 8), std::sin(i * std::numbers::pi / 8));
  }
  const auto points = points_at<TypeParam>(circle);
  double before = 0;
  for (int max_points = 1; max_points <= 15; ++max_points) {
    std::vector<int> kept = reduced(points, max_points);
    EXPECT_EQ(static_cast<int>(kept.size()), max_points);
    const double area = area_of(points, kept);
    EXPECT_GE(area, before);
    before = area;
    std::sort(kept.begin(), kept.end());
    EXPECT_EQ(std::adjacent_find(kept.begin(), kept.end()), kept.end()) << "an index twice";
  }
  EXPECT_GT(before, 3.0);
}

// For a convex polygon in any order, a point sees one edge of the hull of the selected points. The
// triangle that it adds there is the area that this hull gains.
TYPED_TEST(AreaReducer, EachPointFromTheThirdOnAddsTheMostArea) {
  using S = TypeParam;
  test::Random random(9);
  int chosen = 0;
  for (const char* const reducer : {"area", "area_deepest"}) {
    for (const test::Shape shape :
         {test::Shape::Polygon, test::Shape::Clockwise, test::Shape::Shuffled}) {
      for (int i = 0; i < 50; ++i) {
        const auto patch = test::random_patch<S>(random, shape, 12);
        const std::vector<test::Place> places = test::seen_along(patch.points, patch.normal);
        const double rounding = test::area_rounding(patch.points, places);
        ReduceOptions options;
        options.max_points = 9;
        const KeptIndices kept =
            reduce<S>(find_reducer(reducer), patch.points, patch.normal, options);
        std::vector<int> so_far(kept.begin(), kept.begin() + 2);
        for (std::size_t k = 2; k < kept.size(); ++k) {
          double most = 0;
          for (int q = 0; q < 12; ++q) {
            so_far.push_back(q);
            most = std::max(most, test::hull_area(test::at(places, so_far)));
            so_far.pop_back();
          }
          so_far.push_back(kept[k]);
          ASSERT_GE(test::hull_area(test::at(places, so_far)), most - rounding)
              << reducer << ", case " << i << ", point " << k + 1;
          ++chosen;
        }
      }
    }
  }
  EXPECT_EQ(chosen, 2 * 3 * 50 * 7);
}

TYPED_TEST(AreaReducer, KeepsTheTwoExtremesOfALineInAnyDirection) {
  using S = TypeParam;
  for (int turn = 0; turn < 64; ++turn) {
    const double angle = turn * std::numbers::pi / 32;
    std::vector<std::pair<double, double>> line;
    for (const double t : {0.3, -1.0, 0.0, 0.7, 1.0, -0.2}) {
      line.emplace_back(5 + t * std::cos(angle), 3 + t * std::sin(angle));
    }
    const auto points = points_at<S>(line);
    EXPECT_THAT(reduced(points, 4), UnorderedElementsAre(1, 4)) << "direction " << turn;
  }
}

// All points have the same support value along the fixed direction. So the first of them is the
// support point, although it lies between the others.
TYPED_TEST(AreaReducer, KeepsTheTwoExtremesOfALineAcrossTheFixedDirection) {
  using S = TypeParam;
  const Vec3<S> fixed = steps::fixed_direction<S>(Vec3<S>::UnitY());
  const Vec3<S> across(-fixed.z(), 0, fixed.x());
  std::vector<ContactPoint<S>> points;
  // Powers of two cause no rounding.
  for (const double t : {0.0, 1.0, -2.0, 0.5, 4.0, -0.25})
    points.push_back({static_cast<S>(t) * across, S(0), FeatureId{}});
  for (const ContactPoint<S>& point : points) ASSERT_EQ(fixed.dot(point.position), S(0));
  EXPECT_THAT(reduced(points, 4), UnorderedElementsAre(2, 4));
}

TYPED_TEST(AreaReducer, KeepsOneOfCoincidentPoints) {
  const auto points = points_at<TypeParam>({{1, 2}, {1, 2}, {1, 2}, {1, 2}, {1, 2}, {1, 2}});
  EXPECT_EQ(reduced(points, 4).size(), 1u);
}

TYPED_TEST(AreaReducer, ChoosesTheSameAtEveryScale) {
  using S = TypeParam;
  test::Random random(7);
  std::vector<std::pair<double, double>> places;
  for (int i = 0; i < 12; ++i) places.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1));
  const std::vector<int> expected = reduced(points_at<S>(places), 4);
  for (const double scale : {0x1p-20, 0x1p-10, 0x1p10, 0x1p20}) {
    std::vector<std::pair<double, double>> scaled;
    for (const auto& [x, z] : places) scaled.emplace_back(x * scale, z * scale);
    EXPECT_EQ(reduced(points_at<S>(scaled), 4), expected) << scale;
  }
}

TYPED_TEST(AreaReducer, SpansMostOfTheBestArea) {
  using S = TypeParam;
  // The talk's greedy steps keep 94% and more of the best area on average over such polygons.
  test::Random random(8);
  double ratios = 0;
  for (int i = 0; i < 500; ++i) {
    std::vector<std::pair<double, double>> places;
    const double flat = random.uniform(0.3, 1);
    for (int k = 0; k < 8; ++k) {
      const double angle = random.uniform(0, 2 * std::numbers::pi);
      places.emplace_back(std::cos(angle), flat * std::sin(angle));
    }
    const auto points = points_at<S>(places);
    std::vector<Vec3d> all;
    for (const auto& point : points) all.push_back(point.position.template cast<double>());
    const double best = best_convex_area(all, Vec3d::UnitY(), 4);
    const double ratio = area_of(points, reduced(points, 4)) / best;
    ASSERT_LE(ratio, 1 + 1e-12);
    ratios += ratio;
  }
  EXPECT_GT(ratios / 500, 0.94);
}

TEST(Reducers, AreFoundByTheNamesThatAreListed) {
  EXPECT_NE(find_reducer("area"), nullptr);
  EXPECT_NE(find_reducer("area"), find_reducer("distance"));
  EXPECT_EQ(find_reducer("none"), nullptr);
  EXPECT_EQ(find_reducer("Area"), nullptr);
  std::vector<std::string> names;
  for (const ReducerInfo& info : reducers()) {
    names.push_back(info.name);
    EXPECT_FALSE(info.summary.empty());
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"area", "none"}));
}

}  // namespace
}  // namespace contactscope
