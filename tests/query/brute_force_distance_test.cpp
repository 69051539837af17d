#include "support/brute_force_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/builders.h"
#include "support/random_geometry.h"

/// Compares the oracle of distances with known answers and with nested search.
namespace contactscope::test {
namespace {

constexpr double kRounding = 1e-17;

double distance(const Features& a, const Features& b) {
  const double there = static_cast<double>(brute_force_distance(a, b).distance);
  const double back = static_cast<double>(brute_force_distance(b, a).distance);
  EXPECT_EQ(there, back);
  return there;
}

TEST(BruteForceDistance, PointAboveFaceEdgeAndCornerOfACube) {
  const Features box = features_of(cube(1), at(0, 0, 0));
  EXPECT_NEAR(distance(features_of_point({0.25, 0.5, 3}, {}), box), 2, kRounding);
  EXPECT_NEAR(distance(features_of_point({0.25, 4, 5}, {}), box), 5, kRounding);
  EXPECT_NEAR(distance(features_of_point({2, 3, 3}, {}), box), 3, kRounding);
  EXPECT_EQ(distance(features_of_point({0.5, 0.5, 0.5}, {}), box), 0);
  EXPECT_EQ(distance(features_of_point({1, 0.5, 0.5}, {}), box), 0);
}

TEST(BruteForceDistance, CubesFaceToFaceCornerToCornerAndAcrossEdges) {
  const Features box = features_of(cube(1), at(0, 0, 0));
  EXPECT_NEAR(distance(features_of(cube(1), at(0, 2.5, 0.3)), box), 0.5, kRounding);
  EXPECT_NEAR(distance(features_of(cube(1), at(3, 4, 4)), box), 3, kRounding);
  EXPECT_EQ(distance(features_of(cube(1), at(1.9, 1.9, 1.9)), box), 0);
  EXPECT_EQ(distance(features_of(cube(0.1), at(0, 0, 0)), box), 0);
  const PairCase<double> edges = crossed_edges(1, -0.125);
  EXPECT_NEAR(distance(features_of(edges.a, edges.pose_a), features_of(edges.b, edges.pose_b)),
              0.125, 1e-15);
}

TEST(BruteForceDistance, SegmentThroughABoxOverlapsIt) {
  const Features box = features_of(cube(1), at(0, 0, 0));
  EXPECT_EQ(distance(features_of_segment({-5, 0.2, 0.1}, {5, 0.3, 0}, {}), box), 0);
  EXPECT_NEAR(distance(features_of_segment({-5, 2, 0.1}, {5, 2, 0}, {}), box), 1, kRounding);
}

TEST(BruteForceDistance, SegmentsAgreeWithNestedSearch) {
  Random random(51);
  for (int i = 0; i < 500; ++i) {
    const Vec3d a = random.unit_vector(), b = random.unit_vector();
    const Vec3d c = random.decade(-3, 0) * random.unit_vector() + random.unit_vector();
    // Every other pair is nearly parallel.
    const Vec3d along = i % 2 == 0 ? Vec3d(random.unit_vector())
                                   : Vec3d(b - a + random.decade(-10, -1) * random.unit_vector());
    const Features first = features_of_segment(a, b, {});
    const Features second = features_of_segment(c, c + along, {});
    const Extended searched = segment_distance_by_search(first.vertices[0], first.vertices[1],
                                                         second.vertices[0], second.vertices[1]);
    EXPECT_NEAR(distance(first, second), static_cast<double>(searched), 1e-16) << "pair " << i;
  }
}

}  // namespace
}  // namespace contactscope::test
