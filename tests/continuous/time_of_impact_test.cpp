#include "continuous/moving_pair.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/builders.h"

namespace contactscope {
namespace {

using namespace test;

template <class S> class TimeOfImpact : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TimeOfImpact, Scalars);

TYPED_TEST(TimeOfImpact, SlowTranslationMatchesExhaustion) {
  for (const Find<TypeParam> find : kMethods<TypeParam>) {
    Random random(1);
    Tally tally;
    constexpr int kPairs = 300;
    for (int i = 0; i < kPairs; ++i) {
      const double size = random.decade(-3, 3);
      judge<TypeParam>(find, random_moving_pair(random, size, 0, 10), tally);
    }
    expect_right(tally, kPairs);
  }
}

TYPED_TEST(TimeOfImpact, SlowRotationMatchesExhaustion) {
  for (const Find<TypeParam> find : kMethods<TypeParam>) {
    Random random(2);
    Tally tally;
    constexpr int kPairs = 300;
    for (int i = 0; i < kPairs; ++i) {
      const double size = random.decade(-3, 3);
      const double turn = random.decade(-1, 1);
      judge<TypeParam>(find, random_moving_pair(random, size, turn, 10), tally);
    }
    expect_right(tally, kPairs);
  }
}

TYPED_TEST(TimeOfImpact, SlowNothingIsLostFarFromTheOrigin) {
  using S = TypeParam;
  for (const Find<TypeParam> find : kMethods<TypeParam>) {
    Random random(3);
    Tally tally;
    constexpr int kPairs = 100;
    for (int i = 0; i < kPairs; ++i) {
      MovingPair<double> pair = random_moving_pair(random, 0.5, 2, 10);
      const Vec3d away = 1000 * random.unit_vector();
      for (Sweep<double>* motion : {&pair.motion_a, &pair.motion_b}) motion->start.position += away;
      judge<S>(find, pair, tally);
    }
    expect_right(tally, kPairs);
  }
}

/// A ball and a wall: the time is the separation over the speed.
TYPED_TEST(TimeOfImpact, ABallMeetsAWallWhenItHasGoneTheGap) {
  using S = TypeParam;
  const Hull<S> wall = hull_cast<S>(make_box(Vec3d(0.005, 2, 2)));
  const Vec3<S> centre = Vec3<S>::Zero();
  for (const double speed : {0.01, 5.0, 100.0, 1000.0}) {
    MovingShape<S> ball{support_set(centre), {}, S(0.1)};
    ball.motion.start.position = Vec3<S>(S(-1), S(0.3), S(0));
    ball.motion.displacement = Vec3<S>(static_cast<S>(speed), 0, 0);
    const MovingShape<S> plate{support_set(wall), {}, 0};
    const double gap = 1 - 0.1 - 0.005;
    const ImpactResult<S> found = time_of_impact(ball, plate);
    if (gap > speed) {
      EXPECT_EQ(found.status, ImpactStatus::Separated);
      EXPECT_EQ(found.time, S(1));
      continue;
    }
    ASSERT_EQ(found.status, ImpactStatus::Hit);
    EXPECT_LE(static_cast<double>(found.time), gap / speed);
    EXPECT_NEAR(static_cast<double>(found.time), gap / speed, 2e-4);
    EXPECT_GT(found.distance, S(0));
    EXPECT_NEAR(static_cast<double>(found.normal.x()), 1, 1e-5);
    EXPECT_NEAR(static_cast<double>(found.on_b.x()), -0.005, 1e-5);
    EXPECT_NEAR(static_cast<double>(found.on_b.y()), 0.3, 1e-4);
  }
}

/// A rod that turns by half a circle next to a ball. Its end draws a circle, and at both ends of
/// the step it is far from the ball. A comparison of only the ends would report "separated".
TYPED_TEST(TimeOfImpact, ARotatingRodHitsMidStep) {
  using S = TypeParam;
  const Vec3<S> ends[2] = {{S(-1), 0, 0}, {S(1), 0, 0}};
  const Vec3<S> centre = Vec3<S>::Zero();
  MovingShape<S> rod{support_set(ends), {}, S(0.02)};
  rod.motion.turn = Vec3<S>(0, 0, static_cast<S>(std::numbers::pi));
  MovingShape<S> ball{support_set(centre), {}, S(0.05)};
  ball.motion.start.position = Vec3<S>(0, S(0.9), 0);
  const ImpactResult<S> found = time_of_impact(rod, ball);
  ASSERT_EQ(found.status, ImpactStatus::Hit);
  // The rod's axis is .07 from the ball's centre, at .9 from the pivot.
  const double angle = std::numbers::pi / 2 - std::asin(0.07 / 0.9);
  EXPECT_NEAR(static_cast<double>(found.time), angle / std::numbers::pi, 2e-4);
  EXPECT_LE(static_cast<double>(found.time), angle / std::numbers::pi);

  ball.motion.start.position.y() = S(1.08);
  EXPECT_EQ(time_of_impact(rod, ball).status, ImpactStatus::Separated);
}

TYPED_TEST(TimeOfImpact, InitialOverlapDiffersFromAHitAtZero) {
  using S = TypeParam;
  const Vec3<S> centre = Vec3<S>::Zero();
  MovingShape<S> one{support_set(centre), {}, S(0.5)};
  MovingShape<S> two = one;
  two.motion.start.position.x() = S(0.99);
  EXPECT_EQ(time_of_impact(one, two, {.gap = S(1e-3)}).status, ImpactStatus::Overlapping);

  // Within the tolerance at the start and approaching: a hit, at once or soon.
  two.motion.start.position.x() = S(1.0005);
  two.motion.displacement.x() = S(-0.5);
  const ImpactResult<S> hit = time_of_impact(one, two, {.gap = S(1e-3)});
  EXPECT_EQ(hit.status, ImpactStatus::Hit);
  EXPECT_LE(hit.time, S(1e-3));

  // Within the tolerance, but moving away or not at all: no hit.
  two.motion.displacement.x() = S(0.5);
  EXPECT_EQ(time_of_impact(one, two, {.gap = S(1e-3)}).status, ImpactStatus::Separated);
  two.motion.displacement = Vec3<S>(0, 0, 0);
  EXPECT_EQ(time_of_impact(one, two, {.gap = S(1e-3)}).status, ImpactStatus::Separated);
}

/// Height of B's lowest point over the plane, metres.
double height(const MovingPlane<double>& plane, const Core<double>& core,
              const Sweep<double>& motion, double time) {
  const Pose<double> a = placed(plane.motion, time), b = placed(motion, time);
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3d& point : core.hull ? core.hull->vertices : core.points) {
    const Vec3d from_a = b.rotation * point + (b.position - a.position);
    least = std::min(least, plane.plane.distance(a.rotation.conjugate() * from_a));
  }
  return least;
}

/// A plane may turn too: no point of B passes through it undetected.
TYPED_TEST(TimeOfImpact, SlowPlanesMatchAllVertices) {
  using S = TypeParam;
  using FindPlane = ImpactResult<S> (*)(const MovingPlane<S>&, const MovingShape<S>&,
                                        const ImpactLimits<S>&, ImpactRun<S>*);
  for (const FindPlane find :
       std::array<FindPlane, 2>{&time_of_impact<S>, &conservative_advancement<S>}) {
    Random random(5);
    int hits = 0, separation = 0, not_near = 0, undecided = 0;
    for (int i = 0; i < 1000; ++i) {
      const double size = random.decade(-3, 3);
      const MovingPair<double> moving = random_moving_pair(random, size, 1, 12);
      const bool turns = random.chance(0.5);
      MovingPlane<S> plane;
      plane.motion = moving.motion_a.template cast<S>();
      if (!turns) plane.motion.turn.setZero();
      plane.plane.normal = random.unit_vector().template cast<S>().normalized();
      const MovingPair<S> pair = moving.template cast<S>();
      const MovingPair<double> given = pair.template cast<double>();
      const MovingPlane<double> exact{plane.plane.template cast<double>(),
                                      plane.motion.template cast<double>()};
      const auto gap = [&](double time) {
        return height(exact, given.core_b, given.motion_b, time) - given.radius_b;
      };
      // Skip pairs in which B starts behind the plane or close to it.
      if (gap(0) < 0.2 * size) continue;
      const double rounding =
          40 * static_cast<double>(std::numeric_limits<S>::epsilon()) * (60 * size);
      const ImpactResult<S> found = find(plane, pair.b(), {}, nullptr);
      undecided += found.status == ImpactStatus::OutOfIterations;
      const auto time = static_cast<double>(found.time);
      for (int k = 0; k < 400; ++k) {
        ASSERT_GT(gap(time * k / 400), -rounding) << "late " << i;
      }
      if (found.status != ImpactStatus::Hit) {
        ++separation;
        continue;
      }
      ++hits;
      const double most = 1e-5 * 200 * size + 16 * rounding;
      not_near += gap(time) > most;
      EXPECT_LT(std::abs(static_cast<double>((found.on_b - found.on_a).norm()) -
                         static_cast<double>(found.distance)),
                most);
    }
    EXPECT_GT(hits, 100);
    EXPECT_GT(separation, 50);
    EXPECT_EQ(not_near, 0);
    // Gliding past a turning plane may take advancement more steps than it has.
    EXPECT_LE(undecided, 2);
  }
}

TEST(TimeOfImpactRun, EveryStepIsSafe) {
  Random random(4);
  int steps = 0;
  for (int i = 0; i < 20; ++i) {
    const MovingPair<double> pair = random_moving_pair(random, 1, 3, 8);
    ImpactRun<double> run;
    const ImpactResult<double> found = time_of_impact<double>(pair.a(), pair.b(), {}, &run);
    EXPECT_EQ(run.result.time, found.time);
    double reached = 0;
    for (const ImpactStep<double>& step : run.steps) {
      EXPECT_GE(step.time, reached);
      EXPECT_NEAR(step.distance, true_distance(pair, step.time), 1e-9);
      for (const double part : {0.25, 0.5, 0.75, 1.0}) {
        EXPECT_GT(true_distance(pair, step.time + part * (step.safe - step.time)), 0);
      }
      EXPECT_GE(step.bracket_end, step.safe);
      reached = step.safe;
      ++steps;
    }
  }
  EXPECT_GT(steps, 40);
}

}  // namespace
}  // namespace contactscope
