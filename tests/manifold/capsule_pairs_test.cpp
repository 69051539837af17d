#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "manifold/placed_shapes.h"
#include "support/builders.h"

namespace contactscope {
namespace {

using test::kDegree;
using test::PlacedShapes;
using testing::ElementsAre;

template <class S> class CapsulePairs : public testing::Test {
 protected:
  static constexpr double kEps = std::numeric_limits<S>::epsilon();
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(CapsulePairs, Scalars);

/// Two capsules along x: A from -1 to 1 with radius 0.3, B at a place, with radius 0.2.
PlacedShapes capsules(const Vec3d& position, const Quatd& rotation, double half_length_b = 1) {
  return {test::lying_capsule(1, 0.3),
          {},
          test::lying_capsule(half_length_b, 0.2),
          {rotation, position}};
}

TYPED_TEST(CapsulePairs, CrossingCapsulesTouchInOnePointWhereverThePairIs) {
  using S = TypeParam;
  test::Random random(1);
  const PlacedShapes cross = capsules({0.25, 0.47, 0.5}, test::about(Vec3d::UnitY(), 70 * kDegree));
  for (int i = 0; i < 500; ++i) {
    const Pose<double> by = random.pose(3);
    const Manifold<S> manifold = test::manifold_of<S>(test::moved(cross, by));
    ASSERT_EQ(manifold.points.size(), 1u);
    const double rounding = 32 * this->kEps;
    EXPECT_LT((test::normal_of(manifold) - by.rotate(Vec3d::UnitY())).norm(), rounding);
    EXPECT_NEAR(manifold.points[0].separation, -0.03, rounding);
    // B's axis runs along (cos 70, 0, -sin 70); it passes z = 0 at x = 0.25 + 0.5 / tan 70.
    const Vec3d middle(0.25 + 0.5 / std::tan(70 * kDegree), 0.5 * (0.3 + 0.27), 0);
    EXPECT_LT((test::position_of(manifold, 0) - by.transform(middle)).norm(), 2 * rounding);
    EXPECT_EQ(manifold.type, ContactType::EdgeEdge);
    EXPECT_EQ(manifold.axis, AxisKind::ClosestPoints);
    EXPECT_THAT(test::ids_of(manifold), ElementsAre("a:e0 b:e0"));
  }
}

TYPED_TEST(CapsulePairs, ParallelCapsulesTouchAtBothEndsOfTheStretchThatTheyShare) {
  using S = TypeParam;
  test::Random random(2);
  for (int i = 0; i < 500; ++i) {
    const double size = random.decade(-4, 4);
    const Pose<double> by = random.pose(size);
    PlacedShapes pair{test::lying_capsule(size, 0.3 * size),
                      {},
                      test::lying_capsule(size, 0.2 * size),
                      {Quatd::Identity(), Vec3d(0.4, 0.48, 0) * size}};
    const Manifold<S> manifold = test::manifold_of<S>(test::moved(pair, by));
    ASSERT_EQ(manifold.points.size(), 2u);
    const double rounding = 32 * this->kEps;
    EXPECT_LT((test::normal_of(manifold) - by.rotate(Vec3d::UnitY())).norm(), rounding);
    EXPECT_EQ(manifold.type, ContactType::EdgeEdge);
    EXPECT_THAT(test::ids_of(manifold), ElementsAre("a:v0 b:v0", "a:v1 b:v1"));
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(manifold.points[k].separation, -0.02 * size, rounding * size);
      const Vec3d expected(k == 0 ? -0.6 : 1.0, 0.29, 0);
      EXPECT_LT((test::position_of(manifold, k) - by.transform(size * expected)).norm(),
                rounding * size);
    }
  }
}

TYPED_TEST(CapsulePairs, OppositeDirectionsOfTheAxesPairTheOtherEnds) {
  using S = TypeParam;
  const Manifold<S> manifold =
      test::manifold_of<S>(capsules({0.4, 0.48, 0}, test::about(Vec3d::UnitY(), 180 * kDegree)));
  EXPECT_THAT(test::ids_of(manifold), ElementsAre("a:v0 b:v1", "a:v1 b:v0"));
  EXPECT_NEAR(test::position_of(manifold, 0).x(), -0.6, 4 * this->kEps);
  EXPECT_NEAR(test::position_of(manifold, 1).x(), 1, 4 * this->kEps);
}

TYPED_TEST(CapsulePairs, IdsOfBothPointsStayWhileOneCapsuleSlidesAlongTheOther) {
  using S = TypeParam;
  int frames = 0;
  for (double x = -1.45; x < 1.45; x += 0.01) {  // across both ends of A, shorter and past it
    const Manifold<S> manifold =
        test::manifold_of<S>(capsules({x, 0.48, 0}, test::about({0, 0.2, 1}, 1e-3), 0.5));
    ASSERT_THAT(test::ids_of(manifold), ElementsAre("a:v0 b:v0", "a:v1 b:v1")) << "at " << x;
    EXPECT_NEAR(test::position_of(manifold, 0).x(), std::max(-1.0, x - 0.5), 2e-3);
    EXPECT_NEAR(test::position_of(manifold, 1).x(), std::min(1.0, x + 0.5), 2e-3);
    ++frames;
  }
  EXPECT_GT(frames, 200);
}

TYPED_TEST(CapsulePairs, CapsulesEndToEndTouchInOnePoint) {
  using S = TypeParam;
  const Manifold<S> manifold = test::manifold_of<S>(capsules({2.48, 0, 0}, Quatd::Identity()));
  ASSERT_EQ(manifold.points.size(), 1u);
  EXPECT_EQ(manifold.type, ContactType::PointPoint);
  EXPECT_THAT(test::ids_of(manifold), ElementsAre("a:v1 b:v0"));
  EXPECT_NEAR(manifold.points[0].separation, -0.02, 8 * this->kEps);
  EXPECT_LT((test::normal_of(manifold) - Vec3d::UnitX()).norm(), 8 * this->kEps);
  EXPECT_NEAR(test::position_of(manifold, 0).x(), 1.29, 8 * this->kEps);
}

TYPED_TEST(CapsulePairs, EndOnTheSideIsAPointOnAnEdge) {
  using S = TypeParam;
  const Manifold<S> manifold =
      test::manifold_of<S>(capsules({0.1, 1.45, 0}, test::about(Vec3d::UnitZ(), 90 * kDegree)));
  ASSERT_EQ(manifold.points.size(), 1u);
  EXPECT_EQ(manifold.type, ContactType::PointEdge);
  EXPECT_THAT(test::ids_of(manifold), ElementsAre("a:e0 b:v0"));
  EXPECT_NEAR(manifold.points[0].separation, -0.05, 8 * this->kEps);
}

TYPED_TEST(CapsulePairs, SecondPointLeavesAsACapsuleTiltsOutOfIt) {
  using S = TypeParam;
  // About B's first end, 1 cm deep.
  const auto tilted = [](double angle) {
    const Quatd rotation = test::about(Vec3d::UnitZ(), angle);
    return capsules(Vec3d(-0.8, 0.49, 0) + rotation * Vec3d(0.5, 0, 0), rotation, 0.5);
  };
  EXPECT_EQ(test::manifold_of<S>(tilted(0.009)).points.size(), 2u);
  const Manifold<S> one = test::manifold_of<S>(tilted(0.011));
  EXPECT_THAT(test::ids_of(one), ElementsAre("a:v0 b:v0"));
  EXPECT_NEAR(one.points[0].separation, -0.01, 8 * this->kEps);
}

TYPED_TEST(CapsulePairs, NearlyParallelIsJudgedByHowFarLongCapsulesPart) {
  using S = TypeParam;
  const auto yawed = [](double half_length, double angle) {
    return PlacedShapes{test::lying_capsule(half_length, 0.5),
                        {},
                        test::lying_capsule(half_length, 0.5),
                        {test::about(Vec3d::UnitY(), angle), Vec3d(0, 0.99, 0)}};
  };
  EXPECT_EQ(test::manifold_of<S>(yawed(0.5, 0.09)).points.size(), 2u);
  EXPECT_EQ(test::manifold_of<S>(yawed(0.5, 0.11)).points.size(), 1u);
  EXPECT_EQ(test::manifold_of<S>(yawed(50, 0.0009)).points.size(), 2u);
  EXPECT_EQ(test::manifold_of<S>(yawed(50, 0.0011)).points.size(), 1u);
}

TYPED_TEST(CapsulePairs, CapsulesOfLengthZeroAreSpheres) {
  using S = TypeParam;
  test::Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Pose<double> pose_a = random.pose(1);
    const Pose<double> pose_b = random.pose(1);
    const Shape<double> other =
        random.chance(0.5) ? test::upright_capsule(0, 0.5) : test::upright_capsule(0.7, 0.5);
    const Manifold<S> as_sphere = test::manifold_of<S>({test::ball(0.4), pose_a, other, pose_b});
    const Manifold<S> as_capsule =
        test::manifold_of<S>({test::upright_capsule(0, 0.4), pose_a, other, pose_b});
    ASSERT_EQ(as_sphere.points.size(), as_capsule.points.size());
    if (as_sphere.points.empty()) continue;
    const double distance = as_sphere.points[0].separation + 0.9;
    const double rounding = 64 * this->kEps / std::min(1.0, distance);
    EXPECT_LT((test::normal_of(as_sphere) - test::normal_of(as_capsule)).norm(), rounding);
    EXPECT_LT((test::position_of(as_sphere, 0) - test::position_of(as_capsule, 0)).norm(),
              rounding);
    EXPECT_EQ(as_sphere.type, as_capsule.type);
    EXPECT_EQ(test::ids_of(as_sphere), test::ids_of(as_capsule));
  }
}

/// Any size; crossing, nearly parallel or in line; deep, just touching or separated.
PlacedShapes random_capsules(test::Random& random) {
  const double size = random.decade(-4, 4);
  const double half_a = size * (random.chance(0.1) ? 0 : random.decade(-2, 0.5));
  const double half_b = size * (random.chance(0.1) ? 0 : random.decade(-2, 0.5));
  const double radius_a = size * random.uniform(0.1, 1);
  const double radius_b = size * random.uniform(0.1, 1);
  const double angle = random.chance(0.5) ? random.decade(-7, -1) : random.uniform(0, 3.2);
  const double along = random.uniform(-1.2, 1.2) * (half_a + half_b);
  const Vec3d across = random.decade(-2, 0.1) * (radius_a + radius_b) *
                       Vec3d(0, random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
  return test::moved({test::lying_capsule(half_a, radius_a),
                      {},
                      test::lying_capsule(half_b, radius_b),
                      {random.rotation_by(angle), across + along * Vec3d::UnitX()}},
                     random.pose(size));
}

TYPED_TEST(CapsulePairs, SlowRandomPairsAgreeWithASearchInBothParameters) {
  using S = TypeParam;
  test::Random random(4);
  int one = 0;
  int two = 0;
  for (int i = 0; i < 2000; ++i) {
    const PlacedShapes pair = test::rounded<S>(random_capsules(random));
    const test::Core a = test::core_of(pair.a, pair.pose_a);
    const test::Core b = test::core_of(pair.b, pair.pose_b);
    const double distance = test::core_distance(a, b);
    const double separation = distance - a.radius - b.radius;
    const double rounding = 16 * this->kEps * test::extent(a, b);
    const Manifold<S> manifold = test::manifold_of<S>(pair);
    ASSERT_TRUE(test::is_finite(manifold));
    ASSERT_LE(manifold.points.size(), 2u);
    if (std::abs(separation) < rounding) continue;
    ASSERT_EQ(manifold.points.empty(), separation > 0) << "pair " << i;
    if (separation > 0) continue;
    ++(manifold.points.size() == 1 ? one : two);
    const Vec3d normal = test::normal_of(manifold);
    ASSERT_NEAR(normal.norm(), 1, 8 * this->kEps);
    ASSERT_NEAR(test::deepest_of(manifold), separation, rounding) << "pair " << i;
    // The normal points to the right side, and the cores' separation along it is their distance.
    ASSERT_GE(test::gap_along(normal, a, b), distance - 2 * rounding) << "pair " << i;
    for (const ContactPoint<S>& point : manifold.points) {
      // Not outside either capsule by more than the divergence of nearly parallel axes.
      const Vec3d position = point.position.template cast<double>();
      const double parting = manifold.points.size() == 2 ? 0.0051 * (a.radius + b.radius) : 0;
      const Vec3d halfway = 0.5 * static_cast<double>(point.separation) * normal;
      ASSERT_NEAR(test::surface_distance(position - halfway, a), 0, 2 * rounding + parting);
      ASSERT_NEAR(test::surface_distance(position + halfway, b), 0, 2 * rounding + parting);
    }
  }
  EXPECT_GT(one, 500);
  EXPECT_GT(two, 160);
}

TYPED_TEST(CapsulePairs, TwoPointsLieAtTheEndsOfTheSharedStretch) {
  using S = TypeParam;
  test::Random random(5);
  int two = 0;
  for (int i = 0; i < 5000; ++i) {
    const PlacedShapes pair = test::rounded<S>(random_capsules(random));
    const Manifold<S> manifold = test::manifold_of<S>(pair);
    if (manifold.points.size() != 2) continue;
    ++two;
    const test::Core a = test::core_of(pair.a, pair.pose_a);
    const test::Core b = test::core_of(pair.b, pair.pose_b);
    const double length = (a.to - a.from).norm();
    const Vec3d along = (a.to - a.from) / length;
    const double first = along.dot(b.from - a.from);
    const double second = along.dot(b.to - a.from);
    const double from = std::max(0.0, std::min(first, second));
    const double to = std::min(length, std::max(first, second));
    const double slack = 0.11 * (a.radius + b.radius);
    EXPECT_NEAR(along.dot(test::position_of(manifold, 0) - a.from), from, slack);
    EXPECT_NEAR(along.dot(test::position_of(manifold, 1) - a.from), to, slack);
  }
  EXPECT_GT(two, 400);
}

TYPED_TEST(CapsulePairs, AxesThatNearlyCrossGiveTheirCrossProductOnTheRightSide) {
  using S = TypeParam;
  test::Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const double gap = random.decade(-5, -1) * (random.chance(0.5) ? 1 : -1);
    const double angle = random.uniform(0.2, 2.9);
    PlacedShapes pair =
        capsules({random.uniform(-0.5, 0.5), gap, 0}, test::about(Vec3d::UnitY(), angle));
    pair.pose_a = Pose<double>();
    const Manifold<S> manifold = test::manifold_of<S>(pair);
    ASSERT_EQ(manifold.points.size(), 1u);
    const Vec3d up(0, gap > 0 ? 1 : -1, 0);
    ASSERT_LT((test::normal_of(manifold) - up).norm(), 64 * this->kEps) << gap;
    ASSERT_NEAR(manifold.points[0].separation, std::abs(gap) - 0.5, 8 * this->kEps);
  }
}

}  // namespace
}  // namespace contactscope
