#include <gtest/gtest.h>

#include "round_hull_cases.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"

// Geometry that broke real engines: poses and sizes as reported, expected values derived here.
namespace contactscope {
namespace {

using test::about;
using test::at;
using test::collide;
using test::cube;
using test::deepest;
using test::PairCase;

template <class S> CollideOptions margin(double metres) {
  CollideOptions options;
  options.margin = static_cast<S>(metres);
  return options;
}

template <class S> class Regressions : public testing::Test {
 protected:
  static constexpr double kEpsilon = std::numeric_limits<S>::epsilon();
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Regressions, Scalars);

TYPED_TEST(Regressions, Mujoco3476CornersOverlapByFiftySixMicrometres) {
  using S = TypeParam;
  // Two boxes of 71 mm; the reported depth was 71.056 mm.
  const double side = 0.071;
  const double offset = side - 0.056e-3;
  const PairCase<double> pair{cube(side / 2), at(0, 0, 0), cube(side / 2),
                              at(offset, offset, offset)};
  const Manifold<S> manifold = collide(pair.cast<S>());
  ASSERT_FALSE(manifold.points.empty());
  EXPECT_NEAR(deepest(manifold), -0.056e-3, 4 * TestFixture::kEpsilon * side);
  for (const ContactPoint<S>& point : manifold.points) {
    EXPECT_GE(point.separation, S(-0.0561e-3));
    EXPECT_LT(test::distance_to_nearest(manifold, Vec3d::Constant(side / 2)), 0.1e-3);
  }
}

TYPED_TEST(Regressions, MujocoBoxBoxDeepHasFourPoints) {
  using S = TypeParam;
  const PairCase<double> pair{cube(1), at(0, 0, 0), cube(0.2), at(0.1, 0.2, 0.3)};
  for (const bool swap : {false, true}) {
    const Manifold<S> manifold = collide((swap ? test::swapped(pair) : pair).template cast<S>());
    EXPECT_EQ(manifold.points.size(), 4u);
    EXPECT_NEAR(deepest(manifold), -0.9, 16 * TestFixture::kEpsilon);
    EXPECT_EQ(manifold.normal, Vec3<S>::UnitZ() * S(swap ? -1 : 1));
  }
}

TYPED_TEST(Regressions, MujocoBoxBoxBad0HasAMillimetreGapAlongZ) {
  using S = TypeParam;
  // The reported poses touch; a millimetre is added along z for the reported gap.
  const PairCase<double> pair{make_box({0.5, 0.5, 1.5}), at(0.3, 0, 5.5), make_box({1.5, 0.5, 0.5}),
                              at(0.2, 1e-9, 7.501)};
  EXPECT_TRUE(collide(pair.cast<S>()).points.empty());
  const Manifold<S> near = collide(pair.cast<S>(), margin<S>(0.002));
  EXPECT_EQ(near.normal, Vec3<S>::UnitZ());
  ASSERT_EQ(near.points.size(), 4u);
  for (const ContactPoint<S>& point : near.points) {
    EXPECT_NEAR(point.separation, 1e-3, 8 * TestFixture::kEpsilon);
  }
}

TYPED_TEST(Regressions, Newton2438TiltsAboutAFaceEdgeKeepTheFace) {
  using S = TypeParam;
  // Cubes of half extent 0.5, overlap 0.01, tilted about a lower edge of the upper cube. The far
  // edge rises by the tilt, so it stays below the reference face up to 0.01 rad.
  for (double tilt = 1e-7; tilt <= 5e-2; tilt *= 1.25) {
    for (const int sign : {-1, 1}) {
      PairCase<double> pair = test::stacked_cubes(0, 0.01);
      pair.pose_b.rotation = about(Vec3d::UnitZ(), sign * tilt);
      const Vec3d pivot(sign * -0.5, 0.49, 0);
      pair.pose_b.position = pivot - pair.pose_b.rotate({sign * -0.5, -0.5, 0});
      const Manifold<S> manifold = collide(pair.cast<S>());
      EXPECT_EQ(manifold.axis, AxisKind::FaceA) << sign * tilt;
      EXPECT_EQ(manifold.points.size(), tilt < 0.0099 ? 4u : 2u) << sign * tilt;
      EXPECT_NEAR(deepest(manifold), -0.01, 4 * TestFixture::kEpsilon) << sign * tilt;
    }
  }
}

TYPED_TEST(Regressions, Fcl495KissingCubes) {
  using S = TypeParam;
  Mat3<double> rows;
  rows << .94096063, .29296840, .16959542, -.23569837, .92661524, -.29296840, -.24297995, .23569837,
      .94096063;
  const Quatd rotation = Quatd(rows).normalized();
  PairCase<double> pair{cube(0.125),
                        {rotation, {.0732421, .2316538, 1.3089246}},
                        cube(0.125),
                        {rotation, {0, 0, 1.25}}};
  const double expected =
      test::brute_force_sat(pair.a, pair.pose_a, pair.b, pair.pose_b).separation;
  EXPECT_NEAR(expected, 0, 1e-6);  // to the precision of the report
  // Slightly overlapping, slightly separated, and as reported with a margin above its precision.
  const Vec3d away = -pair.pose_a.position + pair.pose_b.position;
  for (const double gap : {-1e-4, 1e-4}) {
    PairCase<double> moved = pair;
    moved.pose_b.position += gap * away.normalized();
    EXPECT_EQ(collide(moved.cast<S>()).points.empty(), gap > 0);
  }
  const Manifold<S> kiss = collide(pair.cast<S>(), margin<S>(1e-5));
  EXPECT_GE(kiss.points.size(), 4u);
  EXPECT_NEAR(deepest(kiss), expected, 1e-6);
  EXPECT_GT(kiss.normal.template cast<double>().dot(away.normalized()), 0.99999);
}

TYPED_TEST(Regressions, Fcl319BoxAndCylinder) {
  using S = TypeParam;
  PairCase<double> pair{make_box({0.025, 0.195, 0.735}),
                        {Quatd(.707107, 0, 0, .707107).normalized(), {.8, -.385, .735}},
                        make_cylinder(0.18, 0.09, 24),
                        {Quatd(.991445, 0, 0, -.130526).normalized(), {.4, -.4, .93}}};
  // FCL's cylinder stands along z, ours along y.
  pair.pose_b.rotation = pair.pose_b.rotation * about(Vec3d::UnitX(), 90 * test::kDegree);
  CollideOptions options = margin<S>(0.03);
  options.preference = Preference::None;
  // A side of 15 degrees faces x after the turn: the box begins at 0.8 - 0.195, the cylinder ends
  // at 0.4 + 0.18. As reported, and pushed on until they meet.
  for (const double pushed : {0.0, 0.05, 0.1}) {
    PairCase<double> there = pair;
    there.pose_b.position.x() += pushed;
    const double separation =
        test::brute_force_sat(there.a, there.pose_a, there.b, there.pose_b).separation;
    EXPECT_NEAR(separation, 0.025 - pushed, 1e-6);  // to the precision of the report
    const Manifold<S> manifold = collide(there.cast<S>(), options);
    ASSERT_EQ(manifold.points.size(), 4u) << pushed;
    EXPECT_NEAR(deepest(manifold), separation, 8 * TestFixture::kEpsilon) << pushed;
    EXPECT_EQ(collide(there.cast<S>()).points.empty(), separation > 0);
  }
}

TYPED_TEST(Regressions, MujocoWarp1597LevelBoxesNeverTakeAnEdgeAxis) {
  using S = TypeParam;
  // Level boxes 0.1 mm from each other, corners 0.4 m out: no rounding may pick an edge in a tie.
  test::Random random(1597);
  for (int i = 0; i < 500; ++i) {
    const PairCase<double> level{make_box({0.4, 0.05, 0.4}), at(0, 0, 0),
                                 make_box({0.4, 0.05, 0.4}), at(0, 0.1001, 0)};
    const PairCase<double> pair = test::moved(level, random.pose(5));
    const Manifold<S> manifold = collide(pair.cast<S>(), margin<S>(1e-3));
    ASSERT_EQ(manifold.axis, AxisKind::FaceA);
    ASSERT_GE(manifold.points.size(), 4u);
    ASSERT_NEAR(deepest(manifold), 1e-4, 16 * TestFixture::kEpsilon);
  }
}

TYPED_TEST(Regressions, MujocoWarp1430DepthStaysAsTheFloorGrows) {
  using S = TypeParam;
  for (const double half : {1.0, 10.0, 25.0, 50.0, 100.0}) {
    const PairCase<double> pair{make_box({half, half, 0.25}), at(0, 0, -0.25), cube(0.1),
                                at(0.3 * half, -0.2 * half, 0.099)};
    const Manifold<S> manifold = collide(pair.cast<S>());
    EXPECT_EQ(manifold.points.size(), 4u) << half;
    EXPECT_EQ(manifold.normal, Vec3<S>::UnitZ()) << half;
    EXPECT_NEAR(deepest(manifold), -0.001, 4 * TestFixture::kEpsilon) << half;
  }
}

TYPED_TEST(Regressions, Bullet1703LargeAndSmallStaticBoxAlike) {
  using S = TypeParam;
  for (const double half : {1.0, 128.0}) {
    for (const double x : {0.0, 0.5}) {
      const PairCase<double> pair{make_box({half, 1, half}), at(0, -1, 0), cube(0.25),
                                  at(x, 0.245, 0.3)};
      const Manifold<S> manifold = collide(pair.cast<S>());
      EXPECT_EQ(manifold.points.size(), 4u);
      EXPECT_NEAR(deepest(manifold), -0.005, 4 * TestFixture::kEpsilon);
    }
  }
}

TYPED_TEST(Regressions, Mujoco2356PegOnACubeKeepsItsFourPoints) {
  using S = TypeParam;
  test::Random random(2356);
  const PairCase<double> pair{cube(0.025), at(0, 0, 0.025), make_box({0.048, 0.01, 0.01}),
                              at(0, 0, 0.06 - 1e-4)};
  const std::vector<FeatureId> expected = test::sorted_ids(collide(pair.cast<S>()));
  ASSERT_EQ(expected.size(), 4u);
  for (int i = 0; i < 200; ++i) {
    PairCase<double> moved = pair;
    moved.pose_b.position += 1e-5 * random.unit_vector();
    moved.pose_b.rotation = random.rotation_by(1e-4);
    EXPECT_EQ(test::sorted_ids(collide(moved.cast<S>())), expected);
  }
}

TYPED_TEST(Regressions, Jolt1488NormalIsThatOfTheLargeFace) {
  using S = TypeParam;
  test::Random random(1488);
  for (int i = 0; i < 300; ++i) {
    PairCase<double> pair{make_box({50, 0.5, 50}), at(0, -0.5, 0), make_box({0.3, 0.2, 0.4}),
                          at(random.uniform(-40, 40), 0.199, random.uniform(-40, 40))};
    pair.pose_b.rotation =
        random.rotation_by(1e-3) * about(Vec3d::UnitY(), random.uniform(0, 6.28));
    const Manifold<S> manifold = collide(pair.cast<S>());
    ASSERT_FALSE(manifold.points.empty()) << i;  // a tilt only lowers the lowest corner
    EXPECT_EQ(manifold.axis, AxisKind::FaceA);
    EXPECT_EQ(manifold.normal, Vec3<S>::UnitY());
  }
}

TYPED_TEST(Regressions, Reactphysics3d347ParallelToAnEdgeOfAThinHullTouches) {
  // No contact was reported for a capsule parallel to a triangle's edge.
  const test::RoundHull pair{{Vec3d(-0.5, 0, 0), Vec3d(0.5, 0, 0)},
                             0.25,
                             at(0, 0.2, 1.1),
                             make_box(Vec3d(2, 1e-4, 1)),
                             at(0, 0, 0)};
  const Manifold<TypeParam> manifold = collide<TypeParam>(pair);
  ASSERT_EQ(manifold.points.size(), 2u);
  EXPECT_NEAR(deepest(manifold), std::hypot(0.2 - 1e-4, 0.1) - 0.25, 16 * TestFixture::kEpsilon);
}

TYPED_TEST(Regressions, Jolt2065FiveCentimetresInANearlyFlatHullOfEightyFourMetres) {
  // Half-height 0.5, radius 0.25, upright on a plate of 84 m; its lower end 0.2 above.
  const test::RoundHull pair{{Vec3d(0, -0.5, 0), Vec3d(0, 0.5, 0)},
                             0.25,
                             at(30.1, 0.7 + 0.001, -12.3),
                             make_box(Vec3d(42, 0.001, 42)),
                             at(0, 0, 0)};
  test::Random random(8);
  for (int i = 0; i < 100; ++i) {
    test::RoundHull turned = pair;
    if (i > 0) {
      const Pose<double> by = random.pose(10);
      turned.round_pose = compose(by, turned.round_pose);
      turned.hull_pose = compose(by, turned.hull_pose);
    }
    const Manifold<TypeParam> manifold = collide<TypeParam>(turned);
    ASSERT_EQ(manifold.points.size(), 1u);
    ASSERT_NEAR(deepest(manifold), -0.05, 32 * TestFixture::kEpsilon * turned.scale());
    const Vec3d down = turned.hull_pose.rotate(-Vec3d::UnitY());
    ASSERT_LT((manifold.normal.template cast<double>() - down).norm(), 16 * TestFixture::kEpsilon);
  }
}

}  // namespace
}  // namespace contactscope
