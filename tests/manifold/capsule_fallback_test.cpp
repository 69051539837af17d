#include <gtest/gtest.h>

#include "manifold/placed_shapes.h"
#include "support/builders.h"

/// Capsules whose axes meet, and how their contacts change with small motions.
namespace contactscope {
namespace {

using test::kDegree;
using test::PlacedShapes;

template <class S> class CapsuleFallback : public testing::Test {
 protected:
  static constexpr double kEps = std::numeric_limits<S>::epsilon();
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(CapsuleFallback, Scalars);

template <class S> CollideOptions skip() {
  CollideOptions options;
  options.degenerate = Degenerate::Skip;
  return options;
}

template <class S> void expect_recorded(const PlacedShapes& pair, const std::string& geometry) {
  const trace::Pair record = test::record_of<S>(pair);
  ASSERT_TRUE(record.degenerate.has_value()) << geometry;
  EXPECT_EQ(record.degenerate->geometry, geometry);
  EXPECT_EQ(record.degenerate->answer, "fallback");
  EXPECT_EQ(record.state, "touching");
  const trace::Pair skipped = test::record_of<S>(pair, skip<S>());
  ASSERT_TRUE(skipped.degenerate.has_value());
  EXPECT_EQ(skipped.degenerate->answer, "skip");
  EXPECT_EQ(skipped.state, "separated");
  EXPECT_TRUE(skipped.manifolds.empty());
}

TYPED_TEST(CapsuleFallback, CrossingAxesGiveTheirCrossProduct) {
  using S = TypeParam;
  test::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const double size = random.decade(-4, 4);
    const Pose<double> by = random.pose(size);
    const Vec3d direction(std::cos(2.0), 0, std::sin(2.0));
    const PlacedShapes pair = test::moved(
        {test::lying_capsule(size, 0.3 * size),
         {},
         Capsule<double>{{Vec3d(-size * direction), Vec3d(size * direction)}, 0.2 * size},
         test::at(random.uniform(-0.9, 0.9) * size, 0, 0)},
        by);
    expect_recorded<S>(pair, "crossing axes");
    const Manifold<S> manifold = test::manifold_of<S>(pair);
    ASSERT_EQ(manifold.points.size(), 1u);
    EXPECT_NEAR(std::abs(test::normal_of(manifold).dot(by.rotate(Vec3d::UnitY()))), 1,
                32 * this->kEps);
    EXPECT_NEAR(manifold.points[0].separation, -0.5 * size, 32 * this->kEps * size);
  }
}

TYPED_TEST(CapsuleFallback, OverlappingAxesInParallelGiveAPerpendicularAndTwoPoints) {
  using S = TypeParam;
  test::Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double size = random.decade(-4, 4);
    const Pose<double> by = random.pose(size);
    const double shift = random.chance(0.2) ? 0 : random.uniform(-1.4, 1.4);
    const PlacedShapes pair = test::moved(
        {test::lying_capsule(size, 0.3 * size),
         {},
         test::lying_capsule(0.5 * size, 0.2 * size),
         {test::about(Vec3d::UnitX(), random.uniform(0, 6)), Vec3d(shift, 0, 0) * size}},
        by);
    expect_recorded<S>(pair, "overlapping axes");
    const Manifold<S> manifold = test::manifold_of<S>(pair);
    ASSERT_EQ(manifold.points.size(), 2u);
    EXPECT_NEAR(test::normal_of(manifold).dot(by.rotate(Vec3d::UnitX())), 0, 32 * this->kEps);
    for (const ContactPoint<S>& point : manifold.points) {
      EXPECT_NEAR(point.separation, -0.5 * size, 32 * this->kEps * size);
    }
  }
}

TYPED_TEST(CapsuleFallback, PointOnAxisDiffersFromPointOnPoint) {
  using S = TypeParam;
  const Shape<double> point = test::upright_capsule(0, 0.3);
  const Shape<double> capsule = test::lying_capsule(1, 0.2);
  const Pose<double> turned{test::about({1, 2, 3}, 1.1), Vec3d(0, 0, 0)};
  expect_recorded<S>({point, {}, point, turned}, "coincident centres");
  expect_recorded<S>({point, {}, capsule, turned}, "centre on the axis");
  expect_recorded<S>({capsule, turned, point, {}}, "centre on the axis");
  for (const bool point_first : {false, true}) {
    const PlacedShapes pair = point_first ? PlacedShapes{point, {}, capsule, turned}
                                          : PlacedShapes{capsule, turned, point, {}};
    const Vec3d normal = test::normal_of(test::manifold_of<S>(pair));
    EXPECT_NEAR(normal.norm(), 1, 8 * this->kEps);
    EXPECT_NEAR(normal.dot(turned.rotate(Vec3d::UnitX())), 0, 8 * this->kEps);
  }
}

/// Largest change from one frame to the next as `pose(t)` moves B.
struct Changes {
  double normal = 0, depth = 0;
  int degenerate_frames = 0, two_points = 0, one_point = 0;
};

template <class S, class Motion>
Changes largest_changes(PlacedShapes pair, int frames, const Motion& pose) {
  Changes changes;
  trace::Pair before;
  for (int i = 0; i < frames; ++i) {
    pair.pose_b = pose(i);
    const trace::Pair now = test::record_of<S>(pair);
    EXPECT_EQ(now.manifolds.size(), 1u) << "frame " << i;
    if (now.manifolds.size() != 1) break;
    changes.degenerate_frames += now.degenerate ? 1 : 0;
    ++(now.manifolds[0].points.size() == 2 ? changes.two_points : changes.one_point);
    if (i > 0) {
      const double turn = (now.manifolds[0].normal - before.manifolds[0].normal).norm();
      changes.normal = std::max(changes.normal, turn);
      changes.depth = std::max(changes.depth, std::abs(now.separation - before.separation));
    }
    before = now;
  }
  return changes;
}

TYPED_TEST(CapsuleFallback, IsPerpendicularToBothAxesAndAsDeepAsTheyAreAtAnySmallAngle) {
  using S = TypeParam;
  test::Random random(3);
  int two_points = 0, degenerate = 0;
  for (int i = 0; i < 4000; ++i) {
    const double size = random.decade(-4, 4);
    const double offset = random.uniform(-0.6, 0.6) * size;
    const Vec3d turn(0, std::cos(0.01 * i), std::sin(0.01 * i));
    const PlacedShapes pair = test::moved(
        {test::lying_capsule(size, 0.3 * size),
         {},
         test::lying_capsule(0.8 * size, 0.2 * size),
         {test::about(turn, random.decade(std::log10(this->kEps), 0)), Vec3d(offset, 0, 0)}},
        random.pose(size));
    const trace::Pair record = test::record_of<S>(pair);
    ASSERT_EQ(record.manifolds.size(), 1u) << i;
    degenerate += record.degenerate ? 1 : 0;
    const trace::Manifold& manifold = record.manifolds[0];
    // The axes of the rounded poses.
    for (const Pose<double>& pose : {pair.pose_a, pair.pose_b}) {
      const Quatd rotation = pose.rotation.template cast<S>().template cast<double>().normalized();
      const Vec3d axis = rotation * Vec3d::UnitX();
      ASSERT_NEAR(manifold.normal.dot(axis), 0, 48 * this->kEps) << i;
    }
    double deepest = 0;
    for (const trace::Point& point : manifold.points) deepest = std::min(deepest, point.separation);
    ASSERT_NEAR(deepest, record.separation, 32 * this->kEps * size) << i;
    ASSERT_NEAR(deepest, -0.5 * size, 32 * this->kEps * size) << i;
    two_points += manifold.points.size() == 2 ? 1 : 0;
  }
  EXPECT_GT(two_points, 2000);
  EXPECT_GT(degenerate, 1000);
}

TYPED_TEST(CapsuleFallback, TurnsWithinRoundingFromOverlappingToCrossingAxes) {
  using S = TypeParam;
  // In place, about perpendiculars of the axes. The cross product alone would appear suddenly.
  const double turn = 48 * this->kEps;  // radians in which the normal becomes the cross product
  const double step = turn / 48;
  for (double direction = 0.3; direction < 2.9; direction += 0.1) {
    const Vec3d about(0, std::cos(direction), std::sin(direction));
    const Changes changes = largest_changes<S>(
        {test::lying_capsule(0.4, 0.3), {}, test::lying_capsule(0.5, 0.3), {}}, 200, [&](int i) {
          return Pose<double>{test::about(about, i * step), Vec3d(0, 0, 0)};
        });
    EXPECT_EQ(changes.degenerate_frames, 200);
    EXPECT_EQ(changes.two_points, 200);
    // Only the directions between them are perpendicular to both axes. The normal turns faster the
    // farther the cross product is from the body's direction; at a right angle it flips.
    const double lean = std::abs(about.z());
    EXPECT_GT(changes.normal, 0);
    EXPECT_LT(changes.normal, 2 * step / turn / lean);
    EXPECT_LT(changes.depth, 32 * this->kEps);
  }
}

TYPED_TEST(CapsuleFallback, StandsStillWhileCrossingAxesTurnOnAndWhenTheyPart) {
  using S = TypeParam;
  // Beyond rounding, the normal is the cross product for axes that meet or not, so nothing jumps.
  for (const double direction : {0.3, 0.9, 2.2}) {
    const Vec3d about(0, std::cos(direction), std::sin(direction));
    const auto turned = [&](int i) {
      const double lift = i > 1400 ? (i - 1400) * 1e-3 : 0;
      return Pose<double>{test::about(about, std::min(i + 1, 1400) * 1e-3), Vec3d(lift * about)};
    };
    // Lifted to the side to which the normal points.
    PlacedShapes pair{test::lying_capsule(0.4, 0.3), {}, test::lying_capsule(0.5, 0.3), turned(0)};
    const Vec3d side = test::normal_of(test::manifold_of<S>(pair));
    const Changes changes = largest_changes<S>(pair, 1500, [&](int i) {
      Pose<double> pose = turned(i);
      if (side.dot(about) < 0) pose.position = -pose.position;
      return pose;
    });
    EXPECT_GE(changes.degenerate_frames, 1400);
    EXPECT_LT(changes.degenerate_frames, 1500);
    EXPECT_GT(changes.two_points, 50);
    EXPECT_GT(changes.one_point, 500);
    EXPECT_LT(changes.normal, 8e3 * this->kEps);  // for poses 0.001 rad from each other
    EXPECT_LT(changes.depth, 1.001e-3);
  }
}

TYPED_TEST(CapsuleFallback, NormalStandsStillInTheBodyWhileTwoOverlappingCapsulesTurnTogether) {
  using S = TypeParam;
  PlacedShapes pair{test::lying_capsule(0.4, 0.3), {}, test::upright_capsule(0.5, 0.3), {}};
  pair.pose_b.rotation = test::about(Vec3d::UnitZ(), 90 * kDegree);
  const Pose<double> b_in_a = pair.pose_b;
  const double step = 0.01;
  Vec3d before;
  for (int i = 0; i < 1500; ++i) {
    pair.pose_a = {test::about(Vec3d(1, 0.4 * std::sin(0.01 * i), 0.5), i * step), {7, 8, 9}};
    pair.pose_b = compose(pair.pose_a, b_in_a);
    const trace::Pair record = test::record_of<S>(pair);
    ASSERT_TRUE(record.degenerate.has_value());
    const Vec3d normal = record.manifolds.at(0).normal;
    if (i > 0) {
      ASSERT_LT((normal - before).norm(), 2 * step) << "frame " << i;
    }
    before = normal;
  }
}

TYPED_TEST(CapsuleFallback, DepthAndNormalFollowATurnFromParallelToCrossing) {
  using S = TypeParam;
  const double step = 1e-3;
  const Vec3d abouts[] = {{0, 1, 0}, {0, 0, 1}, {0, 0.6, 0.8}, {0.3, 0.9, 0.1}};
  for (const Vec3d& about : abouts) {
    const PlacedShapes pair{test::lying_capsule(0.5, 0.5), {}, test::lying_capsule(0.7, 0.4), {}};
    const Changes changes = largest_changes<S>(pair, 1500, [&](int i) {
      return Pose<double>{test::about(about, (i - 500) * step), Vec3d(0.1, 0.6, 0)};
    });
    EXPECT_GT(changes.two_points, 20);
    EXPECT_GT(changes.one_point, 100);
    // No point of B's axis moves by more than 0.8 step; the cores keep a distance of 0.2 or more.
    EXPECT_LT(changes.depth, 0.8 * step + 8 * this->kEps);
    EXPECT_LT(changes.normal, 1.5 * 0.8 * step / 0.2 + 64 * this->kEps);
  }
}

TYPED_TEST(CapsuleFallback, DepthAndNormalFollowACapsuleThatSlidesOffAnother) {
  using S = TypeParam;
  const double step = 1e-3;
  for (const double tilt : {0.0, 1e-6, 1e-3, 0.02, 0.2}) {
    const PlacedShapes pair{test::lying_capsule(0.5, 0.5), {}, test::lying_capsule(0.7, 0.4), {}};
    const Changes changes = largest_changes<S>(pair, 1500, [&](int i) {
      return Pose<double>{test::about({0.2, 1, 1}, tilt), Vec3d(i * step, 0.6, 0.1)};
    });
    EXPECT_LT(changes.depth, step + 8 * this->kEps);
    EXPECT_LT(changes.normal, 4 * step);
    EXPECT_EQ(changes.degenerate_frames, 0);
  }
}

TYPED_TEST(CapsuleFallback, DepthGrowsSmoothlyAsOneCapsuleSinksIntoTheOtherUpToItsAxis) {
  using S = TypeParam;
  const double step = 1e-3;
  for (const double angle : {0.0, 1e-5, 0.02, 0.05, 1.0}) {
    const PlacedShapes pair{test::lying_capsule(0.5, 0.5), {}, test::lying_capsule(0.7, 0.4), {}};
    const Changes changes = largest_changes<S>(pair, 899, [&](int i) {
      return Pose<double>{test::about({0, 1, 0}, angle), Vec3d(0.1, 0.8995 - i * step, 0)};
    });
    EXPECT_LT(changes.depth, step + 8 * this->kEps);
    // In the end the axes are half a step from each other, and their ends are rounded.
    EXPECT_LT(changes.normal, 2 * this->kEps / (0.5 * step));
    EXPECT_EQ(changes.degenerate_frames, 0);
  }
}

}  // namespace
}  // namespace contactscope
