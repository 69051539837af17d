#include <gtest/gtest.h>

#include "geometry/hull_builder.h"
#include "support/builders.h"

namespace contactscope {
namespace {

using test::about;
using test::at;
using test::collide;
using test::cube;
using test::deepest;
using test::distance_to_nearest;
using test::kDegree;
using test::PairCase;
using test::stacked_cubes;

/// A few roundings of coordinates of about a metre.
template <class S> constexpr double kRounding = 16 * std::numeric_limits<S>::epsilon();

template <class S> class FaceContact : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(FaceContact, Scalars);

TYPED_TEST(FaceContact, LevelCubesTouchAtFourCorners) {
  using S = TypeParam;
  const Manifold<S> manifold = collide(stacked_cubes(0, 0.01).cast<S>());
  EXPECT_EQ(manifold.axis, AxisKind::FaceA);
  EXPECT_EQ(manifold.normal, Vec3<S>::UnitY());
  ASSERT_EQ(manifold.points.size(), 4u);
  for (const double x : {-0.5, 0.5}) {
    for (const double z : {-0.5, 0.5}) {
      EXPECT_LT(distance_to_nearest(manifold, {x, 0.5, z}), kRounding<S>);
    }
  }
  for (const ContactPoint<S>& point : manifold.points) {
    EXPECT_NEAR(point.separation, -0.01, kRounding<S>);
  }
}

TYPED_TEST(FaceContact, CubeTurnedByAnEighthMakesAnOctagonOnTheReferenceFace) {
  using S = TypeParam;
  const Manifold<S> manifold = collide(stacked_cubes(45 * kDegree, 0.01).cast<S>());
  ASSERT_EQ(manifold.points.size(), 8u);
  const double side = std::numbers::sqrt2 / 2 - 0.5;
  for (const double half : {-0.5, 0.5}) {
    for (const double other : {-side, side}) {
      EXPECT_LT(distance_to_nearest(manifold, {half, 0.5, other}), kRounding<S>);
      EXPECT_LT(distance_to_nearest(manifold, {other, 0.5, half}), kRounding<S>);
    }
  }
  for (const ContactPoint<S>& point : manifold.points) {
    EXPECT_NEAR(point.separation, -0.01, kRounding<S>);
  }
}

TYPED_TEST(FaceContact, SmallBoxOnLargeKeepsTheSmallFace) {
  using S = TypeParam;
  const PairCase<double> pair{make_box({5, 1, 5}), at(0, -1, 0), make_box({0.2, 0.1, 0.3}),
                              at(1, 0.09, 2)};
  for (const bool swap : {false, true}) {
    const Manifold<S> manifold = collide((swap ? test::swapped(pair) : pair).template cast<S>());
    ASSERT_EQ(manifold.points.size(), 4u);
    EXPECT_NEAR(manifold.normal.y(), swap ? -1 : 1, kRounding<S>);
    // On the reference face, which is A's.
    const double height = swap ? -0.01 : 0;
    for (const double x : {0.8, 1.2}) {
      for (const double z : {1.7, 2.3}) {
        EXPECT_LT(distance_to_nearest(manifold, {x, height, z}), 4 * kRounding<S>);
      }
    }
  }
}

TYPED_TEST(FaceContact, PointsAboveTheReferenceFaceAreDropped) {
  using S = TypeParam;
  PairCase<double> pair = stacked_cubes(0, 0);
  pair.pose_b.rotation = about(Vec3d::UnitZ(), 5 * kDegree);
  pair.pose_b.position.y() = 1.03;
  const Manifold<S> manifold = collide(pair.cast<S>());
  ASSERT_EQ(manifold.points.size(), 2u);
  for (const ContactPoint<S>& point : manifold.points) {
    EXPECT_LE(point.separation, S(0));
    EXPECT_NEAR(point.position.y(), 0.5, kRounding<S>);
  }
}

TYPED_TEST(FaceContact, MarginKeepsPointsOfAGap) {
  using S = TypeParam;
  const PairCase<S> pair = stacked_cubes(10 * kDegree, -0.005).cast<S>();
  CollideOptions options;
  EXPECT_TRUE(collide(pair, options).points.empty());
  options.margin = S(0.01);
  const Manifold<S> manifold = collide(pair, options);
  ASSERT_EQ(manifold.points.size(), 8u);
  for (const ContactPoint<S>& point : manifold.points) {
    EXPECT_NEAR(point.separation, 0.005, kRounding<S>);
    EXPECT_NEAR(point.position.y(), 0.5, kRounding<S>);
  }
}

TYPED_TEST(FaceContact, PencilOnItsTipKeepsTheTip) {
  using S = TypeParam;
  PairCase<double> pair{cube(0.5), at(0, 0, 0), make_cone(0.02, 0.5, 12), at(0.1, 0.99, 0.05)};
  pair.pose_b.rotation = about(Vec3d::UnitX(), 180 * kDegree);
  const Manifold<S> manifold = collide(pair.cast<S>());
  ASSERT_FALSE(manifold.points.empty());
  EXPECT_NEAR(deepest(manifold), -0.01, kRounding<S>);
  EXPECT_LT(distance_to_nearest(manifold, {0.1, 0.5, 0.05}), 2 * kRounding<S>);
  EXPECT_NEAR(manifold.normal.y(), 1, kRounding<S>);
}

TYPED_TEST(FaceContact, BoxWithASpikeBelowItKeepsTheSpike) {
  using S = TypeParam;
  // A cube with a steep small pyramid under its lower face: the talk's incident face, the most
  // anti-parallel of all, does not meet the tip.
  const std::vector<Vec3d> points = {{-1, 0, -1}, {1, 0, -1},  {1, 0, 1},
                                     {-1, 0, 1},  {-1, 2, -1}, {1, 2, -1},
                                     {1, 2, 1},   {-1, 2, 1},  {0.1, -0.3, 0}};
  const PairCase<double> pair{make_box({5, 1, 5}), at(0, -1, 0), build_hull(points),
                              at(0, 0.28, 0)};
  const Manifold<S> manifold = collide(pair.cast<S>());
  ASSERT_FALSE(manifold.points.empty());
  EXPECT_NEAR(deepest(manifold), -0.02, 8 * kRounding<S>);
  EXPECT_LT(distance_to_nearest(manifold, {0.1, 0, 0}), 16 * kRounding<S>);
}

TYPED_TEST(FaceContact, CylinderStandingOnABoxTouchesAtEveryCorner) {
  using S = TypeParam;
  const PairCase<double> pair{make_box({1, 0.5, 1}), at(0, -0.5, 0), make_cylinder(0.3, 0.4, 16),
                              at(0.1, 0.399, -0.2)};
  const Manifold<S> manifold = collide(pair.cast<S>());
  EXPECT_EQ(manifold.points.size(), 16u);
  EXPECT_NEAR(deepest(manifold), -0.001, kRounding<S>);
}

TYPED_TEST(FaceContact, CylinderLyingOnABoxTouchesAlongItsLength) {
  using S = TypeParam;
  const double apothem = 0.3 * std::cos(std::numbers::pi / 16);
  // On one of its sides, and on the edge between two of them.
  for (const bool on_side : {true, false}) {
    const double height = (on_side ? apothem : 0.3) - 0.001;
    const double roll = (on_side ? std::numbers::pi / 16 : 0) + 90 * kDegree;
    PairCase<double> pair{make_box({1, 0.5, 1}), at(0, -0.5, 0), make_cylinder(0.3, 0.4, 16),
                          at(0, height, 0)};
    pair.pose_b.rotation = about(Vec3d::UnitX(), 90 * kDegree) * about(Vec3d::UnitY(), roll);
    const Manifold<S> manifold = collide(pair.cast<S>());
    ASSERT_GE(manifold.points.size(), 2u) << on_side;
    EXPECT_NEAR(deepest(manifold), -0.001, kRounding<S>);
    EXPECT_NEAR(manifold.normal.y(), 1, kRounding<S>);
    // Both ends.
    double least = 1;
    double most = -1;
    for (const ContactPoint<S>& point : manifold.points) {
      least = std::min(least, static_cast<double>(point.position.z()));
      most = std::max(most, static_cast<double>(point.position.z()));
    }
    EXPECT_NEAR(least, -0.4, 2 * kRounding<S>);
    EXPECT_NEAR(most, 0.4, 2 * kRounding<S>);
  }
}

TYPED_TEST(FaceContact, ReducerKeepsFourOfEightAndTouchesNothingElse) {
  using S = TypeParam;
  const PairCase<S> pair = stacked_cubes(45 * kDegree, 0.01).cast<S>();
  CollideOptions options;
  const Manifold<S> all = collide(pair, options);
  options.reducer = find_reducer("area");
  const Manifold<S> four = collide(pair, options);
  ASSERT_EQ(four.points.size(), 4u);
  EXPECT_EQ(four.normal, all.normal);
  for (const ContactPoint<S>& kept : four.points) {
    const bool found = std::any_of(all.points.begin(), all.points.end(), [&](const auto& point) {
      return point.position == kept.position && point.separation == kept.separation &&
             point.id == kept.id;
    });
    EXPECT_TRUE(found);
  }
}

}  // namespace
}  // namespace contactscope
