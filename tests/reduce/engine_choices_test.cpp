#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reduce/plane_points.h"
#include "support/contact_polygons.h"

// The steps of each engine's behaviour, on points chosen by hand.
namespace contactscope {
namespace {

using test::kept_by;
using test::PlanePoint;
using test::points_at;
using testing::Contains;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

TEST(EngineChoices, Box3dStartsWithDepthPlusDistance) {
  // -z is Box3D's fixed direction in a floor.
  const std::vector<PlanePoint> flat = {{0, -3}, {4, 0}, {0, 3}, {-4, 0}, {0, 0}};
  EXPECT_EQ(kept_by("box3d", points_at(flat)).front(), 0);
  std::vector<PlanePoint> deep = flat;
  deep[4].depth = 3.5;
  EXPECT_EQ(kept_by("box3d", points_at(deep)).front(), 4);
}

TEST(EngineChoices, Box3dPrefersAnEarlierPointByFivePercent) {
  // The last point is farther than the one before by 1% or by 5%: 2% and 10% in squares.
  EXPECT_THAT(kept_by("box3d", points_at({{0, -9}, {1, 0}, {-1, 0}, {0, 1}, {0.1, 1.1}})),
              ElementsAre(0, 3, 1, 2));
  EXPECT_THAT(kept_by("box3d", points_at({{0, -9}, {1, 0}, {-1, 0}, {0, 1}, {0.1, 1.5}})),
              ElementsAre(0, 4, 2, 1));
}

TEST(EngineChoices, Box3dMeshStartsWithTheFarthestPair) {
  EXPECT_THAT(kept_by("box3d_mesh", points_at({{0, 0}, {-5, 1}, {0, -2}, {6, 0}, {1, 4}})),
              ElementsAre(1, 3, 4, 2));
}

TEST(EngineChoices, JoltWeighsDistanceWithDepth) {
  // Distance from the centre times depth: 10 x 0.2 against 4 x 1.
  const auto points =
      points_at({{10, 0, 0.2}, {-10, 0, 0.2}, {0, 4, 1}, {0, -4, 1}, {1, 1, 0.1}, {-1, -1, 0.1}});
  EXPECT_THAT(kept_by("jolt", points), ElementsAre(2, 3, 1, 0));
  const auto shallow = points_at(
      {{10, 0, 0.2}, {-10, 0, 0.2}, {0, 4, 0.2}, {0, -4, 0.2}, {1, 1, 0.1}, {-1, -1, 0.1}});
  EXPECT_THAT(kept_by("jolt", shallow), ElementsAre(0, 1, 2, 3));
}

TEST(EngineChoices, BulletAlwaysTakesTheArrivingPoint) {
  // Each square loses the corner next to the inner point, although that point contributes less.
  const std::vector<PlanePoint> square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const PlanePoint inside[] = {{0.5, 0.5}, {1.5, 0.5}, {1.5, 1.5}, {0.5, 1.5}};
  for (int corner = 0; corner < 4; ++corner) {
    std::vector<PlanePoint> places = square;
    places.push_back(inside[corner]);
    const auto kept = kept_by("bullet", points_at(places));
    EXPECT_EQ(kept.size(), 4u);
    EXPECT_THAT(kept, Contains(4));
    EXPECT_THAT(kept, testing::Not(Contains(corner)));
  }
}

TEST(EngineChoices, BulletProtectsTheDeepestFromTheArrivingPoint) {
  EXPECT_THAT(kept_by("bullet", points_at({{0, 0}, {2, 0, 0.1}, {2, 2}, {0, 2}, {1.5, 0.5}})),
              testing::AllOf(Contains(1), Contains(4)));
}

TEST(EngineChoices, OdeTakesThePointsNearestToRightAngles) {
  // Degrees around the centroid: 0 (deepest), 27, 90, 117, 180, 207, 270, 297.
  const auto points =
      points_at({{2, 1}, {2, 0, 0.1}, {-1, 2}, {0, 2}, {-2, -1}, {-2, 0}, {1, -2}, {0, -2}});
  EXPECT_THAT(kept_by("ode", points), ElementsAre(1, 7, 5, 3));
}

TEST(EngineChoices, OdeTurnsAroundTheCentroidOfTheAreaNotOfThePoints) {
  // Many points on the right shift their mean, not the area's centroid, to that side. From the
  // mean, point 7 would be nearer to 90 degrees than the corner 1.
  const auto points = points_at({{-1, -1},
                                 {1, -1},
                                 {1, 1, 0.1},
                                 {-1, 1},
                                 {1, 0.125},
                                 {1, -0.125},
                                 {1, 0.25},
                                 {1, -0.25},
                                 {1, 0}});
  EXPECT_THAT(kept_by("ode", points), ElementsAre(2, 1, 0, 3));
}

TEST(EngineChoices, PhysxTakesBothSidesOfTheLineFromTheDeepest) {
  const auto points = points_at({{5, 1}, {0, 0, 0.1}, {5, 3}, {10, 0}, {4, -2}, {6, -1}});
  EXPECT_THAT(kept_by("physx", points), ElementsAre(1, 3, 4, 2));
}

TEST(EngineChoices, PhysxKeepsThreeWhenASideIsEmpty) {
  EXPECT_THAT(kept_by("physx", points_at({{0, 0, 0.1}, {10, 0}, {3, 1}, {5, 3}, {7, 1}})),
              ElementsAre(0, 1, 3));
}

TEST(EngineChoices, PhysxClusterGivesEachCornerToItsDeepestNeighbour) {
  const auto points = points_at({{4, 4, 0.1},
                                 {-4, 4, 0.1},
                                 {-4, -4, 0.1},
                                 {4, -4, 0.1},
                                 {3, 3, 0.3},
                                 {-3, 3, 0.5},
                                 {-3, -3, 0.2},
                                 {3, -3, 0.4}});
  EXPECT_THAT(kept_by("physx_cluster", points), ElementsAre(5, 7, 4, 6));
}

TEST(EngineChoices, NewtonStartsWithTheDiameter) {
  // Calipers walk the hull; the oracle compares all pairs of all points.
  test::Random random(9);
  for (int i = 0; i < 2000; ++i) {
    std::vector<PlanePoint> places;
    const int count = 3 + random.index(30);
    const double flat = random.decade(-3, 0);
    const double steps = random.decade(0, 3);  // coarse ones make parallel edges and duplicates
    for (int k = 0; k < count; ++k) {
      places.push_back({std::round(steps * random.uniform(-1, 1)) / steps,
                        flat * std::round(steps * random.uniform(-1, 1)) / steps});
    }
    const auto separated = [&](int a, int b) {
      const PlanePoint& p = places[static_cast<std::size_t>(a)];
      const PlanePoint& q = places[static_cast<std::size_t>(b)];
      return std::hypot(p.x - q.x, p.z - q.z);
    };
    double farthest = 0;
    for (int a = 0; a < count; ++a) {
      for (int b = 0; b < a; ++b) farthest = std::max(farthest, separated(a, b));
    }
    const auto kept = kept_by("newton", points_at(places), 2);
    if (farthest == 0) {
      EXPECT_EQ(kept.size(), 1u);
    } else {
      ASSERT_EQ(kept.size(), 2u);
      EXPECT_NEAR(separated(kept[0], kept[1]), farthest, 1e-14);
    }
  }
}

TEST(EngineChoices, NewtonTakesBothSidesOfTheDiameter) {
  EXPECT_THAT(kept_by("newton", points_at({{0, 0}, {5, 1}, {5, 3}, {10, 0}, {4, -2}, {6, -1}})),
              UnorderedElementsAre(0, 3, 2, 4));
}

TEST(EngineChoices, MjxWastesItsFourthChoiceOnASquare) {
  // The first corner is as far from the others' edge as the missing one from its own, and is first.
  EXPECT_THAT(kept_by("mjx", points_at({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}})),
              ElementsAre(0, 2, 1));
  EXPECT_THAT(kept_by("mjx", points_at({{0, 0}, {1.9, -0.9}, {2, 2}, {-1, 2.5}, {1, 1}})),
              ElementsAre(0, 2, 3, 1));
}

class FourPointReducer : public testing::TestWithParam<std::string> {};

TEST_P(FourPointReducer, KeepsTheFirstOfItsChoicesForASmallerCount) {
  test::Random random(12);
  for (int i = 0; i < 100; ++i) {
    const test::ContactPolygon polygon = test::random_contact_polygon(random, 9);
    ReduceOptions options;
    const auto reducer = find_reducer(GetParam());
    const KeptIndices four = reduce<double>(reducer, polygon.points, polygon.normal, options);
    for (const int max_points : {1, 2, 3, 6}) {
      options.max_points = max_points;
      const KeptIndices kept = reduce<double>(reducer, polygon.points, polygon.normal, options);
      ASSERT_EQ(kept.size(), std::min(four.size(), static_cast<std::size_t>(max_points)));
      EXPECT_TRUE(std::equal(kept.begin(), kept.end(), four.begin()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, FourPointReducer,
                         testing::Values("extremes", "box3d", "box3d_mesh", "jolt", "bullet", "ode",
                                         "physx", "physx_cluster", "newton", "mjx"),
                         [](const auto& listed) { return listed.param; });

}  // namespace
}  // namespace contactscope
