#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "reduce/brute_force.h"
#include "reduce/reducer.h"

namespace contactscope {
namespace {

using test::Place;
using test::RandomPatch;
using test::Shape;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

template <class S>
std::vector<int> reduced(const ReducerInfo* reducer, const std::vector<ContactPoint<S>>& points,
                         const Vec3<S>& normal, int max_points) {
  ReduceOptions options;
  options.max_points = max_points;
  options.scale =
      std::numeric_limits<S>::min();  // only equal depths tie: the oracles ignore rounding
  const KeptIndices kept = reduce<S>(reducer, points, normal, options);
  return {kept.begin(), kept.end()};
}

/// Points in the x-y plane, z up, with these separations.
template <class S>
std::vector<ContactPoint<S>> points_at(const std::vector<Place>& places,
                                       const std::vector<double>& separations = {}) {
  std::vector<ContactPoint<S>> points;
  for (const Place& place : places) {
    const double separation = separations.empty() ? 0 : separations[points.size()];
    points.push_back({Vec3d(place.x, place.y, 0).cast<S>(), static_cast<S>(separation), {}});
  }
  return points;
}

template <class S> int deepest(const std::vector<ContactPoint<S>>& points) {
  int best = 0;
  for (int i = 1; i < static_cast<int>(points.size()); ++i) {
    if (points[static_cast<std::size_t>(i)].separation <
        points[static_cast<std::size_t>(best)].separation) {
      best = i;
    }
  }
  return best;
}

template <class S> class OptimalReducer : public testing::Test {
 protected:
  static std::vector<int> best(const std::vector<ContactPoint<S>>& points, int max_points) {
    return reduced<S>(find_reducer("optimal"), points, Vec3<S>::UnitZ(), max_points);
  }
  static std::vector<int> best_with_deepest(const std::vector<ContactPoint<S>>& points,
                                            int max_points) {
    return reduced<S>(find_reducer("optimal_deepest"), points, Vec3<S>::UnitZ(), max_points);
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(OptimalReducer, Scalars);

TYPED_TEST(OptimalReducer, SlowNoChoiceOfAnyPointsHasMoreArea) {
  using S = TypeParam;
  test::Random random(21);
  for (const Shape shape : test::kShapes) {
    for (int i = 0; i < 400; ++i) {
      const int count = 5 + random.index(i < 350 ? 5 : 8);
      const RandomPatch<S> patch = test::random_patch<S>(random, shape, count);
      const std::vector<Place> places = test::seen_along(patch.points, patch.normal);
      const double rounding = test::area_rounding(patch.points, places);
      for (int most = 3; most <= 6; ++most) {
        if (count <= most) continue;
        const std::vector<int> kept =
            reduced<S>(find_reducer("optimal"), patch.points, patch.normal, most);
        ASSERT_NEAR(test::hull_area(test::at(places, kept)), test::largest_area(places, most),
                    rounding)
            << "shape " << static_cast<int>(shape) << ", case " << i << ", most " << most;
      }
    }
  }
}

TYPED_TEST(OptimalReducer, SlowNoChoiceWithTheDeepestHasMoreArea) {
  using S = TypeParam;
  test::Random random(22);
  for (const Shape shape : test::kShapes) {
    for (int i = 0; i < 400; ++i) {
      const int count = 5 + random.index(i < 350 ? 5 : 8);
      RandomPatch<S> patch = test::random_patch<S>(random, shape, count);
      // Half of the patches are no tilted planes: any point may be the deepest, even inside.
      if (random.chance(0.5)) {
        patch.points[static_cast<std::size_t>(random.index(count))].separation *= S(3);
      }
      const std::vector<Place> places = test::seen_along(patch.points, patch.normal);
      const double rounding = test::area_rounding(patch.points, places);
      const int first = deepest(patch.points);
      for (int most = 1; most <= 6; ++most) {
        if (count <= most) continue;
        const std::vector<int> kept =
            reduced<S>(find_reducer("optimal_deepest"), patch.points, patch.normal, most);
        ASSERT_EQ(kept[0], first);
        const double largest = test::largest_area(
            places, most, [&](const std::vector<int>& c) { return std::ranges::count(c, first); });
        ASSERT_NEAR(test::hull_area(test::at(places, kept)), largest, rounding)
            << "shape " << static_cast<int>(shape) << ", case " << i << ", most " << most;
      }
    }
  }
}

TYPED_TEST(OptimalReducer, KeepsTheFarthestTwo) {
  using S = TypeParam;
  test::Random random(23);
  for (const Shape shape : test::kShapes) {
    for (int i = 0; i < 200; ++i) {
      const RandomPatch<S> patch = test::random_patch<S>(random, shape, 5 + random.index(8));
      const std::vector<Place> places = test::seen_along(patch.points, patch.normal);
      const double extent = test::extent(places);
      const double tolerance = test::area_rounding(patch.points, places) / extent;
      const std::vector<int> two =
          reduced<S>(find_reducer("optimal"), patch.points, patch.normal, 2);
      ASSERT_NEAR(test::extent(test::at(places, two)), extent, tolerance);

      const std::vector<int> with_deepest =
          reduced<S>(find_reducer("optimal_deepest"), patch.points, patch.normal, 2);
      const int first = deepest(patch.points);
      ASSERT_EQ(with_deepest[0], first);
      double farthest = 0;
      for (const Place& place : places) {
        farthest =
            std::max(farthest, test::distance(places[static_cast<std::size_t>(first)], place));
      }
      ASSERT_NEAR(test::extent(test::at(places, with_deepest)), farthest, tolerance);
    }
  }
}

TYPED_TEST(OptimalReducer, IsExactForManyPointsInAnyOrder) {
  using S = TypeParam;
  test::Random random(24);
  for (const int count : {16, 24, 40, 64}) {
    for (int i = 0; i < 12; ++i) {
      const std::vector<ContactPoint<S>> points = points_at<S>(test::crowd(random, count, i));
      const std::vector<Place> places = test::seen_along<S>(points, Vec3<S>::UnitZ());
      EXPECT_NEAR(test::hull_area(test::at(places, this->best(points, 4))),
                  test::largest_quadrilateral(places), test::area_rounding(points, places));
    }
  }
}

// Twelve points are few enough to try all choices.
TEST(LargestQuadrilateral, IsThatOfAllSubsets) {
  test::Random random(25);
  for (int i = 0; i < 6; ++i) {
    const std::vector<Place> places = test::crowd(random, 12, i);
    EXPECT_NEAR(test::largest_quadrilateral(places), test::largest_area(places, 4), 1e-12);
  }
}

TYPED_TEST(OptimalReducer, WithTheDeepestIsExactForManyPoints) {
  using S = TypeParam;
  test::Random random(26);
  for (const int count : {16, 24, 40, 64}) {
    for (int i = 0; i < (count < 40 ? 12 : 3); ++i) {
      std::vector<double> separations(static_cast<std::size_t>(count), 0);
      const int first = random.index(count);
      separations[static_cast<std::size_t>(first)] = -1;
      const std::vector<ContactPoint<S>> points =
          points_at<S>(test::crowd(random, count, i), separations);
      const std::vector<Place> places = test::seen_along<S>(points, Vec3<S>::UnitZ());
      const std::vector<int> kept = this->best_with_deepest(points, 4);
      EXPECT_EQ(kept[0], first);
      EXPECT_NEAR(test::hull_area(test::at(places, kept)),
                  test::largest_quadrilateral_with(places, first),
                  test::area_rounding(points, places))
          << count << " points, case " << i;
    }
  }
}

TYPED_TEST(OptimalReducer, EveryPointOfARegularPolygonOf256) {
  using S = TypeParam;
  std::vector<Place> places;
  for (int i = 0; i < 256; ++i) {
    places.push_back({std::cos(i * std::numbers::pi / 128), std::sin(i * std::numbers::pi / 128)});
  }
  const auto points = points_at<S>(places);
  EXPECT_NEAR(test::hull_area(test::at(places, this->best(points, 4))), 2, 1e-5);
  EXPECT_NEAR(test::hull_area(test::at(places, this->best_with_deepest(points, 4))), 2, 1e-5);
  const double hexagon = 1.5 * std::sqrt(3.0);
  EXPECT_NEAR(test::hull_area(test::at(places, this->best(points, 6))), hexagon, 1e-3);
}

TYPED_TEST(OptimalReducer, GoesRoundCounterClockwiseFromTheDeepest) {
  using S = TypeParam;
  const std::vector<Place> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}};
  EXPECT_THAT(this->best(points_at<S>(square, {0, 0, -1, 0, -2}), 4), ElementsAre(2, 3, 0, 1));
  EXPECT_THAT(this->best_with_deepest(points_at<S>(square, {0, 0, -1, 0, 0}), 4),
              ElementsAre(2, 3, 0, 1));
  const std::vector<Place> clockwise = {{0, 1}, {1.1, 1.1}, {1, 0}, {0.4, -0.1}, {0, 0}};
  EXPECT_THAT(this->best(points_at<S>(clockwise, {0, 0, -1, -2, 0}), 4), ElementsAre(2, 1, 0, 4));
  EXPECT_THAT(this->best_with_deepest(points_at<S>(clockwise, {0, 0, -1, 0, 0}), 4),
              ElementsAre(2, 1, 0, 4));
}

TYPED_TEST(OptimalReducer, TheDeepestInsideTakesTheRoomOfACorner) {
  using S = TypeParam;
  // The triangle 1 2 3 has an area of 10; the deepest point, outside its long edge, adds 2.
  const std::vector<Place> places = {{0, 0}, {4, 0}, {5, 4}, {0, 4}, {2, 1}};
  EXPECT_THAT(this->best_with_deepest(points_at<S>(places, {0, 0, 0, 0, -1}), 4),
              ElementsAre(4, 1, 2, 3));
}

TYPED_TEST(OptimalReducer, KeepsOneOfTwoCoincidentCorners) {
  using S = TypeParam;
  const std::vector<Place> places = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 1}, {0, 0}};
  EXPECT_THAT(this->best(points_at<S>(places), 4), UnorderedElementsAre(0, 1, 2, 3));
  EXPECT_THAT(this->best_with_deepest(points_at<S>(places, {0, 0, 0, 0, -1, 0}), 4),
              ElementsAre(4, 3, 0, 1));
}

TYPED_TEST(OptimalReducer, KeepsTheTwoExtremesOfALineAndTheDeepestBetween) {
  using S = TypeParam;
  for (int turn = 0; turn < 64; ++turn) {
    const double angle = turn * std::numbers::pi / 32;
    std::vector<Place> line;
    for (const double t : {0.3, -1.0, 0.0, 0.7, 1.0, -0.2}) {
      line.push_back({5 + t * std::cos(angle), 3 + t * std::sin(angle)});
    }
    const auto points = points_at<S>(line, {0, 0, -1, 0, 0, 0});
    EXPECT_THAT(this->best(points, 4), UnorderedElementsAre(1, 4)) << "direction " << turn;
    EXPECT_THAT(this->best(points, 2), UnorderedElementsAre(1, 4)) << "direction " << turn;
    EXPECT_THAT(this->best_with_deepest(points, 4), UnorderedElementsAre(2, 1, 4));
    const auto end_deepest = points_at<S>(line, {0, 0, 0, 0, -1, 0});
    EXPECT_THAT(this->best_with_deepest(end_deepest, 4), ElementsAre(4, 1));
    EXPECT_THAT(this->best_with_deepest(end_deepest, 2), ElementsAre(4, 1));
  }
}

TYPED_TEST(OptimalReducer, KeepsOneOfCoincidentPoints) {
  using S = TypeParam;
  const std::vector<Place> places(7, Place{1, 2});
  for (const int most : {1, 2, 3, 4, 5}) {
    EXPECT_EQ(this->best(points_at<S>(places), most).size(), 1U);
    EXPECT_THAT(this->best_with_deepest(points_at<S>(places, {0, 0, 0, -1, 0, 0, 0}), most),
                ElementsAre(3));
  }
}

TYPED_TEST(OptimalReducer, OneAloneIsTheSupportPointOrTheDeepest) {
  using S = TypeParam;
  const std::vector<Place> places = {{-1, -1}, {1, -1}, {1.5, 1.5}, {-1, 1}, {0, 0}};
  EXPECT_THAT(this->best(points_at<S>(places), 1), ElementsAre(2));
  EXPECT_THAT(this->best_with_deepest(points_at<S>(places, {0, 0, 0, 0, -1}), 1), ElementsAre(4));
}

TYPED_TEST(OptimalReducer, KeepsSomeOfPointsWhoseAreaOverflows) {
  using S = TypeParam;
  const double huge = std::sqrt(static_cast<double>(std::numeric_limits<S>::max()));
  for (const int count : {5, 6, 7, 8, 9, 16, 17}) {
    for (const double scale : {0.1, 0.3, 0.6, 1.0, 2.0, 1e3, 1e15}) {
      std::vector<Place> places;
      for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        places.push_back({scale * huge * std::cos(angle), scale * huge * std::sin(angle)});
      }
      const std::vector<int> kept = this->best(points_at<S>(places), 4);
      ASSERT_FALSE(kept.empty());
      ASSERT_LE(kept.size(), 4U);
      for (const int index : kept) {
        ASSERT_GE(index, 0);
        ASSERT_LT(index, count);
      }
    }
  }
}

TYPED_TEST(OptimalReducer, AStarThatTurnsLeftEverywhereIsNoConvexPolygon) {
  using S = TypeParam;
  std::vector<Place> places;
  for (int i = 0; i < 5; ++i) {
    const double angle = 4 * i * std::numbers::pi / 5;
    places.push_back({std::cos(angle), std::sin(angle)});
  }
  const auto points = points_at<S>(places);
  const std::vector<int> kept = this->best(points, 4);
  EXPECT_NEAR(test::hull_area(test::at(places, kept)), test::largest_area(places, 4), 1e-6);
}

}  // namespace
}  // namespace contactscope
