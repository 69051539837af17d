#include "query/sat.h"

#include <gtest/gtest.h>

#include <cmath>

#include "query/tolerance.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"

namespace contactscope {
namespace {

using test::about;
using test::at;
using test::cube;
using test::kDegree;
using test::PairCase;

template <class S>
SatResult<S> sat_of(const PairCase<S>& pair, Preference preference = Preference::None,
                    S margin = 0) {
  return sat(HullPair<S>(pair.a, pair.b, relative_pose(pair.pose_a, pair.pose_b)), margin,
             preference);
}

double oracle(const PairCase<double>& pair) {
  return test::brute_force_sat(pair.a, pair.pose_a, pair.b, pair.pose_b).separation;
}

template <class S> class Sat : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Sat, Scalars);

TYPED_TEST(Sat, StackedCubesGiveTheUpperFaceOfTheLower) {
  using S = TypeParam;
  const SatResult<S> result = sat_of(test::stacked_cubes(20 * kDegree, 0.01).cast<S>());
  EXPECT_EQ(result.status, SatStatus::Touching);
  EXPECT_EQ(result.face_a.face, 2);  // +y
  EXPECT_EQ(result.face_b.face, 3);  // -y
  EXPECT_NEAR(result.face_a.separation, -0.01, 4 * std::numeric_limits<S>::epsilon());
  EXPECT_NEAR(result.face_b.separation, -0.01, 4 * std::numeric_limits<S>::epsilon());
  EXPECT_EQ(result.deepest, AxisKind::FaceA);
}

TYPED_TEST(Sat, CrossedEdgesGiveAnEdgeAxis) {
  using S = TypeParam;
  const PairCase<double> pair = test::crossed_edges(1, 0.01);
  const SatResult<S> result = sat_of(pair.cast<S>());
  EXPECT_EQ(result.status, SatStatus::Touching);
  EXPECT_EQ(result.chosen, AxisKind::EdgeEdge);
  EXPECT_NEAR(result.edge.separation, oracle(pair), 16 * std::numeric_limits<S>::epsilon());
  EXPECT_NEAR(result.edge.separation, -0.01, 16 * std::numeric_limits<S>::epsilon());
  const Vec3<S> world = pair.pose_a.template cast<S>().rotate(result.edge.normal);
  EXPECT_NEAR(world.y(), 1, 8 * std::numeric_limits<S>::epsilon());
}

TYPED_TEST(Sat, StopsAtTheFirstQueryThatSeparates) {
  using S = TypeParam;
  // Separated by a face of A; by a face of B only; by neither but by edges.
  const PairCase<double> face_a{cube(0.5), at(0, 0, 0), cube(0.5), at(0, 1.1, 0)};
  const SatResult<S> by_a = sat_of(face_a.cast<S>());
  EXPECT_EQ(by_a.status, SatStatus::Separated);
  EXPECT_EQ(by_a.queries_run, 1);
  EXPECT_EQ(by_a.chosen, AxisKind::FaceA);
  EXPECT_NEAR(by_a.face_a.separation, 0.1, 8 * std::numeric_limits<S>::epsilon());

  PairCase<double> face_b{cube(0.5), at(0, 0, 0), cube(0.5), at(0.92, 0.92, 0)};
  face_b.pose_b.rotation = about(Vec3d::UnitZ(), 45 * kDegree);
  const SatResult<S> by_b = sat_of(face_b.cast<S>());
  EXPECT_EQ(by_b.status, SatStatus::Separated);
  EXPECT_EQ(by_b.queries_run, 2);
  EXPECT_EQ(by_b.chosen, AxisKind::FaceB);

  const SatResult<S> by_edges = sat_of(test::crossed_edges(1, -0.01).cast<S>());
  EXPECT_EQ(by_edges.status, SatStatus::Separated);
  EXPECT_EQ(by_edges.queries_run, 3);
  EXPECT_EQ(by_edges.chosen, AxisKind::EdgeEdge);
  EXPECT_NEAR(by_edges.edge.separation, 0.01, 16 * std::numeric_limits<S>::epsilon());
}

TYPED_TEST(Sat, MarginTurnsASmallGapIntoATouch) {
  using S = TypeParam;
  const PairCase<S> pair = test::stacked_cubes(20 * kDegree, -0.01).cast<S>();
  EXPECT_EQ(sat_of(pair, Preference::None, S(0.009)).status, SatStatus::Separated);
  EXPECT_EQ(sat_of(pair, Preference::None, S(0.011)).status, SatStatus::Touching);
}

TYPED_TEST(Sat, NearlyParallelEdgesNeverSeparateOverlappingBoxes) {
  using S = TypeParam;
  // Edge on edge, lengthwise: the cross product of the two long edges is mostly rounding.
  for (double decade = -12; decade <= -1; decade += 0.25) {
    for (const double aspect : {1.0, 30.0}) {
      PairCase<double> pair{make_box(Vec3d(0.5, 0.5, 0.5 * aspect)), at(0, 0, 0),
                            make_box(Vec3d(0.5, 0.5, 0.5 * aspect)), at(0, 0, 0)};
      pair.pose_a.rotation = about(Vec3d::UnitZ(), 45 * kDegree);
      pair.pose_b.rotation =
          about(Vec3d::UnitX(), std::pow(10, decade)) * about(Vec3d::UnitZ(), 47 * kDegree);
      pair.pose_b.position = Vec3d(0.02, 1.35, 0.1);
      const PairCase<S> rounded = pair.cast<S>();
      const double expected = oracle(rounded.template cast<double>());
      const SatResult<S> result = sat_of(rounded);
      const double tolerance = 16 * aspect * std::numeric_limits<S>::epsilon();
      EXPECT_NEAR(result.separation(result.deepest), expected, tolerance) << "1e" << decade;
      EXPECT_EQ(result.status, SatStatus::Touching) << "1e" << decade;
    }
  }
}

TYPED_TEST(Sat, ExactTiesKeepTheEarlierFaceWhereverThePairStands) {
  using S = TypeParam;
  // A cube in the middle of a cube: all six faces tie in both queries, also after quarter turns.
  test::Random random(1597);
  for (int i = 0; i < 200; ++i) {
    const Quatd turn = about(Vec3d::UnitX(), 90 * kDegree * random.index(4)) *
                       about(Vec3d::UnitY(), 90 * kDegree * random.index(4));
    const PairCase<double> pair = test::moved(
        PairCase<double>{cube(0.5), at(0, 0, 0), cube(0.4), {turn, Vec3d::Zero()}}, random.pose(5));
    const SatResult<S> result = sat_of(pair.cast<S>(), Preference::Relative);
    ASSERT_EQ(result.face_a.face, 0);
    ASSERT_EQ(result.face_b.face, 0);
    ASSERT_EQ(result.chosen, AxisKind::FaceA);
  }
}

TYPED_TEST(Sat, PreferenceTakesAFaceThatIsLittleDeeperThanAnEdge) {
  using S = TypeParam;
  // Tilted about its lower edge until the edge pair barely has the least overlap.
  bool differed = false;
  for (double tilt = 0.1; tilt < 8; tilt += 0.1) {
    PairCase<double> pair = test::stacked_cubes(30 * kDegree, 0.02);
    pair.pose_b.rotation = about(Vec3d::UnitX(), tilt * kDegree) * pair.pose_b.rotation;
    const SatResult<S> pure = sat_of(pair.cast<S>(), Preference::None);
    const SatResult<S> preferred = sat_of(pair.cast<S>(), Preference::Relative);
    const S best = pure.separation(pure.chosen);
    const S allowed = preference_tolerance(best, S(0.8660254));
    ASSERT_EQ(pure.chosen, pure.deepest);
    ASSERT_LE(preferred.separation(preferred.chosen), best + S(1e-6));
    ASSERT_GE(preferred.separation(preferred.chosen), best - allowed - S(1e-6));
    differed = differed || pure.chosen != preferred.chosen;
  }
  EXPECT_TRUE(differed) << "no tilt at which the preference matters";
}

TYPED_TEST(Sat, PreferenceTakesAFaceOfTheSecondHullWhereNoneOfTheFirstIsNearTheEdge) {
  using S = TypeParam;
  // A small cube, slightly tilted, on the edge of another one. Its level face is nearly as deep as
  // the two edges, and the faces of the first cube are at 45 degrees.
  int of_second = 0;
  for (double tilt = 0.01; tilt < 0.06; tilt += 0.01) {
    PairCase<double> pair{cube(0.5), at(0, 0, 0), cube(0.3), at(0, 0.5 * std::sqrt(2) + 0.29, 0)};
    pair.pose_a.rotation = about(Vec3d::UnitX(), 45 * kDegree);
    pair.pose_b.rotation = about(Vec3d::UnitZ(), tilt * kDegree);
    const SatResult<S> pure = sat_of(pair.cast<S>(), Preference::None);
    const SatResult<S> preferred = sat_of(pair.cast<S>(), Preference::Relative);
    ASSERT_EQ(pure.chosen, AxisKind::EdgeEdge) << tilt;
    ASSERT_LT(pure.face_a.separation, S(-0.1)) << tilt;
    EXPECT_EQ(preferred.chosen, AxisKind::FaceB) << tilt;
    ++of_second;
  }
  EXPECT_GE(of_second, 3);
}

TEST(BruteForceSat, FindsTheGapOfLevelAndOfCrossedCubes) {
  EXPECT_NEAR(oracle(test::stacked_cubes(0.3, 0.01)), -0.01, 1e-14);
  EXPECT_NEAR(oracle(test::stacked_cubes(0.3, -0.25)), 0.25, 1e-14);
  EXPECT_NEAR(oracle(test::crossed_edges(1, 0.01)), -0.01, 1e-14);
  EXPECT_NEAR(oracle(test::crossed_edges(2, -0.5)), 0.5, 1e-14);
}

}  // namespace
}  // namespace contactscope
