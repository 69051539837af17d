#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "manifold/placed_shapes.h"
#include "support/builders.h"

namespace contactscope {
namespace {

using test::PlacedShapes;
using testing::ElementsAre;

template <class S> class SpherePairs : public testing::Test {
 protected:
  static constexpr double kEps = std::numeric_limits<S>::epsilon();
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SpherePairs, Scalars);

/// A sphere of radius 0.3 next to a capsule along y, in its frame, and the expected contact.
struct Case {
  const char* name;
  Vec3d center;
  Vec3d closest;  // on the axis from -1 to 1
  ContactType type;
  const char* id;
};
const Case kCases[] = {
    {"beside the middle", {0.6, 0.2, 0}, {0, 0.2, 0}, ContactType::PointEdge, "a:v0 b:e0"},
    {"beside the end", {0, 1.1, -0.6}, {0, 1, 0}, ContactType::PointPoint, "a:v0 b:v1"},
    {"above the end", {0.3, 1.4, 0}, {0, 1, 0}, ContactType::PointPoint, "a:v0 b:v1"},
    {"straight below the end", {0, -1.5, 0}, {0, -1, 0}, ContactType::PointPoint, "a:v0 b:v0"},
    {"deep inside", {0.01, -0.4, 0.02}, {0, -0.4, 0}, ContactType::PointEdge, "a:v0 b:e0"},
};

TYPED_TEST(SpherePairs, SphereTouchesTheClosestPointOfACapsulesAxisWhereverThePairIs) {
  using S = TypeParam;
  test::Random random(1);
  for (const Case& expected : kCases) {
    for (int i = 0; i < 200; ++i) {
      const double size = random.decade(-4, 4);
      const Pose<double> by = random.pose(size);
      const PlacedShapes pair = test::moved({test::ball(0.3 * size),
                                             {Quatd::Identity(), size * expected.center},
                                             test::upright_capsule(size, 0.4 * size),
                                             {}},
                                            by);
      const Manifold<S> manifold = test::manifold_of<S>(pair);
      SCOPED_TRACE(expected.name);
      ASSERT_EQ(manifold.points.size(), 1u);
      const Vec3d to_axis = expected.closest - expected.center;
      const Vec3d normal = by.rotate(to_axis.normalized());
      const double rounding = 16 * this->kEps;
      EXPECT_LT((test::normal_of(manifold) - normal).norm(), rounding / to_axis.norm());
      EXPECT_NEAR(manifold.points[0].separation, size * (to_axis.norm() - 0.7), rounding * size);
      // In the middle of the two surface points, not of the closest points.
      const Vec3d on_a = expected.center + 0.3 * to_axis.normalized();
      const Vec3d on_b = expected.closest - 0.4 * to_axis.normalized();
      const Vec3d middle = by.transform(size * 0.5 * (on_a + on_b));
      EXPECT_LT((test::position_of(manifold, 0) - middle).norm(),
                size * rounding / std::min(1.0, to_axis.norm()));
      EXPECT_EQ(manifold.axis, AxisKind::ClosestPoints);
      EXPECT_EQ(manifold.type, expected.type);
      EXPECT_THAT(test::ids_of(manifold), ElementsAre(expected.id));
    }
  }
}

TYPED_TEST(SpherePairs, SlowRandomPairsAgreeWithASearchAlongTheAxis) {
  using S = TypeParam;
  test::Random random(2);
  int touching = 0;
  for (int i = 0; i < 20000; ++i) {
    const double size = random.decade(-4, 4);
    const auto ball_or_capsule = [&] {
      const double radius = size * random.uniform(0.1, 1);
      if (random.chance(0.3)) return test::ball(radius);
      const Vec3d along = size * random.uniform(0, 3) * random.unit_vector();
      const Vec3d middle = size * random.uniform(0, 1) * random.unit_vector();
      return Shape<double>(Capsule<double>{{middle - along, middle + along}, radius});
    };
    const PlacedShapes pair =
        test::rounded<S>({test::ball(size * random.uniform(0.1, 1)), random.pose(size),
                          ball_or_capsule(), random.pose(3 * size)});
    const test::Core a = test::core_of(pair.a, pair.pose_a);
    const test::Core b = test::core_of(pair.b, pair.pose_b);
    const double separation = test::surface_distance(a.from, b) - a.radius;
    const double rounding = 16 * this->kEps * test::extent(a, b);
    const Manifold<S> manifold = test::manifold_of<S>(pair);
    ASSERT_TRUE(test::is_finite(manifold));
    if (std::abs(separation) < rounding) continue;
    ASSERT_EQ(manifold.points.size(), separation < 0 ? 1u : 0u) << "pair " << i;
    if (separation >= 0) continue;
    ++touching;
    const Vec3d normal = test::normal_of(manifold);
    ASSERT_NEAR(normal.norm(), 1, 8 * this->kEps);
    ASSERT_NEAR(manifold.points[0].separation, separation, rounding) << "pair " << i;
    ASSERT_GE(test::gap_along(normal, a, b), separation + a.radius + b.radius - rounding);
    const Vec3d halfway = 0.5 * separation * normal;
    ASSERT_NEAR(test::surface_distance(test::position_of(manifold, 0) - halfway, a), 0,
                2 * rounding);
    ASSERT_NEAR(test::surface_distance(test::position_of(manifold, 0) + halfway, b), 0,
                2 * rounding);
  }
  EXPECT_GT(touching, 2000);
}

TYPED_TEST(SpherePairs, SpheresTouchOnlyAtZeroSeparationOrWithinTheMargin) {
  using S = TypeParam;
  const auto at_distance = [](double distance) {
    return PlacedShapes{test::ball(0.5), {}, test::ball(0.25), test::at(0, 0, distance)};
  };
  EXPECT_EQ(test::manifold_of<S>(at_distance(0.75)).points.size(), 1u);
  EXPECT_EQ(test::manifold_of<S>(at_distance(0.76)).points.size(), 0u);
  CollideOptions options;
  options.margin = S(0.02);
  const Manifold<S> near = test::manifold_of<S>(at_distance(0.76), options);
  ASSERT_EQ(near.points.size(), 1u);
  EXPECT_NEAR(near.points[0].separation, 0.01, 1e-6);
  EXPECT_LT((test::position_of(near, 0) - Vec3d(0, 0, 0.505)).norm(), 1e-6);
  EXPECT_EQ(near.type, ContactType::PointPoint);
  EXPECT_NEAR(test::record_of<S>(at_distance(1)).separation, 0.25, 1e-6);
}

TYPED_TEST(SpherePairs, CentresThatDifferByTheSmallestNumbersStillHaveAUnitNormal) {
  using S = TypeParam;
  const double tiny = static_cast<double>(std::numeric_limits<S>::denorm_min());
  const Manifold<S> manifold =
      test::manifold_of<S>({test::ball(1), {}, test::ball(1), test::at(tiny, tiny, 0)});
  const Vec3d diagonal = Vec3d(1, 1, 0).normalized();
  EXPECT_LT((test::normal_of(manifold) - diagonal).norm(), 4 * this->kEps);
}

TYPED_TEST(SpherePairs, CoincidentCentresFallBackToADirectionOfTheSecondBody) {
  using S = TypeParam;
  test::Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Vec3d center = random.uniform(0, 10) * random.unit_vector();
    const PlacedShapes pair{
        test::ball(0.5), {random.rotation(), center}, test::ball(0.2), {random.rotation(), center}};
    const Manifold<S> manifold = test::manifold_of<S>(pair);
    ASSERT_EQ(manifold.points.size(), 1u);
    EXPECT_LT((test::normal_of(manifold) - pair.pose_b.rotate(Vec3d::UnitY())).norm(),
              16 * this->kEps);
    EXPECT_NEAR(manifold.points[0].separation, -0.7, 1e-6);

    CollideOptions skip;
    skip.degenerate = Degenerate::Skip;
    EXPECT_TRUE(test::manifold_of<S>(pair, skip).points.empty());
    const trace::Pair record = test::record_of<S>(pair, skip);
    EXPECT_EQ(record.state, "separated");
    EXPECT_NEAR(record.separation, -0.7, 1e-6);
    ASSERT_TRUE(record.degenerate.has_value());
    EXPECT_EQ(record.degenerate->geometry, "coincident centres");
    EXPECT_EQ(record.degenerate->answer, "skip");
    EXPECT_EQ(test::record_of<S>(pair).degenerate->answer, "fallback");
  }
}

TYPED_TEST(SpherePairs, CoincidentCentresGoUpWhateverTheBodiesRotations) {
  using S = TypeParam;
  test::Random random(5);
  CollideOptions up;
  up.degenerate = Degenerate::Up;
  for (int i = 0; i < 100; ++i) {
    up.up = random.unit_vector();
    const Vec3d center = random.uniform(0, 10) * random.unit_vector();
    const PlacedShapes balls{
        test::ball(0.5), {random.rotation(), center}, test::ball(0.2), {random.rotation(), center}};
    EXPECT_LT((test::normal_of(test::manifold_of<S>(balls, up)) - up.up).norm(), 32 * this->kEps);
    EXPECT_EQ(test::record_of<S>(balls, up).degenerate->answer, "up");

    // Off a capsule's axis it can only go at right angles, as far up as that allows.
    const PlacedShapes on_axis{test::ball(0.2),
                               {random.rotation(), Vec3d::Zero()},
                               test::upright_capsule(1, 0.3),
                               {random.rotation(), Vec3d::Zero()}};
    const Vec3d axis = on_axis.pose_b.rotate(Vec3d::UnitY());
    const Vec3d across = up.up - up.up.dot(axis) * axis;
    if (across.norm() < 0.1) continue;
    EXPECT_LT((test::normal_of(test::manifold_of<S>(on_axis, up)) - across.normalized()).norm(),
              1e-5);
  }
}

TYPED_TEST(SpherePairs, CentreOnACapsulesAxisIsPushedOutAtRightAnglesToIt) {
  using S = TypeParam;
  test::Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const double size = random.decade(-4, 4);
    const Vec3d along = size * random.unit_vector();
    const Vec3d middle =
        random.chance(0.5) ? Vec3d(Vec3d::Zero()) : Vec3d(size * random.unit_vector());
    const Shape<double> capsule = Capsule<double>{{middle - along, middle + along}, 0.3 * size};
    const Pose<double> pose = random.pose(size);
    const double place = random.chance(0.2) ? 1 : random.uniform(-1, 1);
    const PlacedShapes pair{test::ball(0.2 * size),
                            {random.rotation(), pose.transform(middle + place * along)},
                            capsule,
                            pose};
    const trace::Pair record = test::record_of<S>(pair);
    ASSERT_TRUE(record.degenerate.has_value()) << "pair " << i;
    EXPECT_EQ(record.degenerate->geometry, "centre on the axis");
    ASSERT_EQ(record.manifolds.size(), 1u);
    const Vec3d normal = record.manifolds[0].normal;
    EXPECT_NEAR(normal.norm(), 1, 16 * this->kEps);
    EXPECT_NEAR(normal.dot(pose.rotate(along / size)), 0, 16 * this->kEps);
    EXPECT_NEAR(record.separation, -0.5 * size, 256 * this->kEps * size);
  }
}

TYPED_TEST(SpherePairs, FallbackTurnsWithTheCapsuleAndDoesNotJump) {
  using S = TypeParam;
  // Includes orientations in which a helper axis chosen in the world would switch.
  PlacedShapes pair{test::ball(0.2), test::at(3, 4, 5), test::upright_capsule(1, 0.3),
                    test::at(3, 4, 5)};
  const double step = 0.01;
  Vec3d before = test::normal_of(test::manifold_of<S>(pair));
  for (int i = 1; i < 2000; ++i) {
    const Quatd turn = test::about(Vec3d(1, 0.2 * std::sin(i * 0.01), 0.3), i * step);
    pair.pose_b.rotation = turn;
    const trace::Pair record = test::record_of<S>(pair);
    ASSERT_TRUE(record.degenerate.has_value());
    const Vec3d normal = record.manifolds.at(0).normal;
    ASSERT_LT((normal - before).norm(), 2 * step) << "step " << i;
    before = normal;
  }
}

TYPED_TEST(SpherePairs, CapsuleOfLengthZeroIsASphere) {
  using S = TypeParam;
  test::Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const Pose<double> pose_a = random.pose(1);
    const Pose<double> pose_b =
        i % 4 == 0 ? Pose<double>{random.rotation(), pose_a.position} : random.pose(1);
    const Manifold<S> as_sphere =
        test::manifold_of<S>({test::ball(0.5), pose_a, test::ball(0.4), pose_b});
    const Manifold<S> as_capsule =
        test::manifold_of<S>({test::ball(0.5), pose_a, test::upright_capsule(0, 0.4), pose_b});
    ASSERT_EQ(as_sphere.points.size(), as_capsule.points.size());
    if (as_sphere.points.empty()) continue;
    const double distance = (pose_a.position - pose_b.position).norm();
    const double rounding = 16 * this->kEps / (distance > 0 ? std::min(1.0, distance) : 1.0);
    EXPECT_LT((test::normal_of(as_sphere) - test::normal_of(as_capsule)).norm(), rounding);
    EXPECT_LT((test::position_of(as_sphere, 0) - test::position_of(as_capsule, 0)).norm(),
              rounding);
    EXPECT_EQ(as_capsule.type, ContactType::PointPoint);
    EXPECT_EQ(test::ids_of(as_sphere), test::ids_of(as_capsule));
  }
}

TYPED_TEST(SpherePairs, SmallSphereNearTheAxisOfAVeryLongCapsuleLeavesOnItsOwnSide) {
  using S = TypeParam;
  // Places along the axis are rounded to 1 mm in single precision, but the distance is 0.1 mm.
  const double distance = 1e-4;
  for (const double angle : {0.0, 1.0, 2.5, 4.0}) {
    const Vec3d side(std::cos(angle), 0, std::sin(angle));
    PlacedShapes pair{test::ball(1e-3), {}, test::upright_capsule(1e4, 1e-3), {}};
    pair.pose_a.position = distance * side;
    const trace::Pair record = test::record_of<S>(pair);
    EXPECT_FALSE(record.degenerate.has_value());
    ASSERT_EQ(record.manifolds.size(), 1u);
    EXPECT_LT((record.manifolds[0].normal + side).norm(), 1e-5);
    EXPECT_NEAR(record.separation, distance - 2e-3, 1e-8);
  }
}

}  // namespace
}  // namespace contactscope
