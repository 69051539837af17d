#include "continuous/impact.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "support/brute_force_distance.h"
#include "support/builders.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Features;
using test::Random;

/// Two shapes that move: cores as hulls, segments or points.
template <class S>
struct Core {
  std::vector<Vec3<S>> points;  // one or two, if there is no hull
  std::optional<Hull<S>> hull;

  template <class T>
  Core<T> cast() const {
    Core<T> result;
    for (const Vec3<S>& point : points) result.points.push_back(point.template cast<T>());
    if (hull) result.hull = hull_cast<T>(*hull);
    return result;
  }
  SupportSet<S> set() const {
    if (hull) return support_set(*hull);
    return {points.data(), static_cast<int>(points.size()), nullptr};
  }
};

template <class S>
struct MovingPair {
  Core<S> core_a, core_b;
  Sweep<S> motion_a, motion_b;
  S radius_a = 0, radius_b = 0;

  template <class T>
  MovingPair<T> cast() const {
    return {core_a.template cast<T>(),   core_b.template cast<T>(), motion_a.template cast<T>(),
            motion_b.template cast<T>(), static_cast<T>(radius_a),  static_cast<T>(radius_b)};
  }
  MovingShape<S> a() const { return {core_a.set(), motion_a, radius_a}; }
  MovingShape<S> b() const { return {core_b.set(), motion_b, radius_b}; }
};

/// The oracle's own way to move: an angle and an axis.
Pose<double> placed(const Sweep<double>& motion, double time) {
  const double angle = motion.turn.norm();
  Quatd by = Quatd::Identity();
  if (angle > 0) by = Quatd(Eigen::AngleAxisd(time * angle, motion.turn / angle));
  const Quatd start = motion.start.rotation.normalized();
  const Vec3d pivot = start * motion.pivot + motion.start.position;
  const Quatd rotation = by * start;
  return {rotation, pivot + time * motion.displacement - rotation * motion.pivot};
}

Features features(const Core<double>& core, const Pose<double>& pose) {
  if (core.hull) return test::features_of(*core.hull, pose);
  if (core.points.size() == 1) return test::features_of_point(core.points[0], pose);
  return test::features_of_segment(core.points[0], core.points[1], pose);
}

/// By exhaustion, at a time. Both are moved to where A is, as the oracle's features are in double.
double true_distance(const MovingPair<double>& pair, double time) {
  Pose<double> a = placed(pair.motion_a, time), b = placed(pair.motion_b, time);
  const Vec3d origin = a.position;
  a.position -= origin;
  b.position -= origin;
  const auto found = brute_force_distance(features(pair.core_a, a), features(pair.core_b, b));
  return static_cast<double>(found.distance) - pair.radius_a - pair.radius_b;
}

/// No point of one moves farther beside the other in the step, metres.
double most_motion(const MovingPair<double>& pair) {
  const auto turning = [](const Core<double>& core, const Sweep<double>& motion) {
    double most = 0;
    for (const Vec3d& point : core.hull ? core.hull->vertices : core.points) {
      const Vec3d arm = motion.start.rotation.normalized() * (point - motion.pivot);
      most = std::max(most, motion.turn.cross(arm).norm());
    }
    return most;
  };
  return (pair.motion_b.displacement - pair.motion_a.displacement).norm() +
         turning(pair.core_a, pair.motion_a) + turning(pair.core_b, pair.motion_b);
}

/// The first time at which they are within `gap` metres: steps that are as long as the distance
/// allows, whatever moves; nothing where there is none. Where it would take more than `most` steps,
/// the time that is reached, which is too early if it is wrong.
std::optional<double> first_time_within(const MovingPair<double>& pair, double gap, double speed,
                                        double from = 0, int most = 4000) {
  double time = from;
  for (int i = 0; i < most; ++i) {
    const double distance = true_distance(pair, time);
    if (distance <= gap) return time;
    // A little more than is certain, so that it ends: less than a thousandth of the gap.
    time += (distance - 0.999 * gap) / speed;
    if (time > 1) return std::nullopt;
  }
  return time;
}

Core<double> random_core(Random& random, double size, int& vertices) {
  switch (random.index(4)) {
    case 0:
      return {{Vec3d::Zero()}, {}};
    case 1: {
      const Vec3d half = size * random.unit_vector();
      return {{-half, half}, {}};
    }
    case 2:
      return {{}, test::random_box(random, size, 4)};
    default:
      return {{}, test::random_hull(random, vertices, size, 4)};
  }
}

/// Two bodies some sizes apart, of which B goes at A or near it, turning or not.
MovingPair<double> random_moving_pair(Random& random, double size, double most_turn, int vertices) {
  MovingPair<double> pair;
  pair.core_a = random_core(random, size, vertices);
  pair.core_b = random_core(random, size, vertices);
  if (pair.core_a.points.size() + pair.core_b.points.size() > 0 && random.chance(0.7)) {
    pair.radius_a = random.uniform(0, 0.5) * size;
    pair.radius_b = random.uniform(0, 0.5) * size;
  }
  pair.motion_a.start = random.pose(0.1 * size);
  pair.motion_b.start = random.pose(0.1 * size);
  const Vec3d way = random.unit_vector();
  pair.motion_b.start.position += random.uniform(2, 5) * size * way;
  const Vec3d aim = random.vector(-1, 1);
  const double far = random.decade(-0.3, 1);
  const Vec3d relative = far * (size * aim - pair.motion_b.start.position);
  const Vec3d common = size * random.vector(-5, 5);
  pair.motion_a.displacement = common;
  pair.motion_b.displacement = common + relative;
  for (Sweep<double>* motion : {&pair.motion_a, &pair.motion_b}) {
    motion->pivot = size * random.vector(-0.3, 0.3);
    if (most_turn > 0 && random.chance(0.8)) {
      const double angle = most_turn * random.uniform(0, 1);
      motion->turn = angle * random.unit_vector();
    }
  }
  return pair;
}

/// 32 roundings of what both shapes reach and go, with room for how that is bounded.
template <class S>
double least_tolerance(const MovingPair<double>& pair) {
  const auto reach = [](const Core<double>& core) {
    double most = 0;
    for (const Vec3d& point : core.hull ? core.hull->vertices : core.points)
      most = std::max(most, point.norm());
    return most;
  };
  const double extent = (pair.motion_b.start.position - pair.motion_a.start.position).norm() +
                        most_motion(pair) +
                        3 * (reach(pair.core_a) + reach(pair.core_b) + pair.motion_a.pivot.norm() +
                             pair.motion_b.pivot.norm() + pair.radius_a + pair.radius_b);
  return 64 * static_cast<double>(std::numeric_limits<S>::epsilon()) * extent;
}

/// What a run of many pairs came to.
struct Tally {
  int hits = 0, misses = 0, invented = 0, late = 0, not_near = 0, early = 0, undecided = 0;
  int steps = 0, bounds = 0, most_steps = 0;
};

template <class S>
using Find = ImpactResult<S> (*)(const MovingShape<S>&, const MovingShape<S>&,
                                 const ImpactLimits<S>&, ImpactRun<S>*);

template <class S>
constexpr std::array<Find<S>, 2> kMethods = {&time_of_impact<S>, &conservative_advancement<S>};

template <class S>
void judge(Find<S> find, const MovingPair<double>& exact, Tally& tally) {
  constexpr double kOfMotion = 1e-5;
  const MovingPair<S> pair = exact.template cast<S>();
  // As it was rounded: the oracle judges the very numbers that the function was given.
  const MovingPair<double> given = pair.template cast<double>();
  const double speed = most_motion(given);
  // The function knows what moves farthest by a ball about each hull, which is up to twice as far.
  const double tolerance = std::max(2 * kOfMotion * speed, least_tolerance<S>(given));
  if (true_distance(given, 0) <= tolerance) return;
  const ImpactResult<S> found =
      find(pair.a(), pair.b(), {.of_motion = static_cast<S>(kOfMotion)}, nullptr);
  tally.steps += found.steps;
  tally.bounds += found.bounds;
  tally.most_steps = std::max(tally.most_steps, found.steps);
  const auto time = static_cast<double>(found.time);
  const double slack = 1e-3 * tolerance;
  const std::optional<double> touches = first_time_within(given, slack, speed);
  switch (found.status) {
    case ImpactStatus::Hit: {
      ++tally.hits;
      tally.late += touches && *touches < time;
      const double distance = true_distance(given, time);
      tally.not_near += distance > 1.01 * tolerance;
      tally.invented += !touches;
      tally.early += touches && *touches - time > 2e-4;
      break;
    }
    case ImpactStatus::Separated:
      tally.misses += touches.has_value();
      break;
    case ImpactStatus::OutOfIterations:
      ++tally.undecided;
      tally.late += touches && *touches < time;
      break;
    case ImpactStatus::Overlapping:
      ADD_FAILURE() << "apart at the start by more than the tolerance";
  }
}

void expect_right(const Tally& tally, int of) {
  EXPECT_EQ(tally.misses, 0);
  EXPECT_EQ(tally.late, 0);
  EXPECT_EQ(tally.not_near, 0);
  EXPECT_EQ(tally.undecided, 0);
  EXPECT_GT(tally.hits, of / 5);
  EXPECT_LE(tally.early + tally.invented, tally.hits / 100 + 1);
  std::printf("hits %d, invented %d, early %d, steps %.1f, most %d, bounds %.1f\n", tally.hits,
              tally.invented, tally.early, double(tally.steps) / of, tally.most_steps,
              double(tally.bounds) / of);
}

template <class S>
class TimeOfImpact : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TimeOfImpact, Scalars);

TYPED_TEST(TimeOfImpact, SlowTranslationIsAsExhaustionSays) {
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

TYPED_TEST(TimeOfImpact, SlowRotationIsAsExhaustionSays) {
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

/// A ball and a wall: the time is the gap over the speed.
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

/// A rod that turns by half a circle beside a ball: its end draws a circle, and at both ends of the
/// step it is far from the ball. Whoever compares ends only says "separated".
TYPED_TEST(TimeOfImpact, ARodThatTurnsPastHitsOnItsWay) {
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

TYPED_TEST(TimeOfImpact, OverlapAtTheStartIsToldApartFromAHitAtZero) {
  using S = TypeParam;
  const Vec3<S> centre = Vec3<S>::Zero();
  MovingShape<S> one{support_set(centre), {}, S(0.5)};
  MovingShape<S> two = one;
  two.motion.start.position.x() = S(0.99);
  EXPECT_EQ(time_of_impact(one, two, {.gap = S(1e-3)}).status, ImpactStatus::Overlapping);

  // Within the tolerance at the start and coming nearer: a hit, at once or soon.
  two.motion.start.position.x() = S(1.0005);
  two.motion.displacement.x() = S(-0.5);
  const ImpactResult<S> hit = time_of_impact(one, two, {.gap = S(1e-3)});
  EXPECT_EQ(hit.status, ImpactStatus::Hit);
  EXPECT_LE(hit.time, S(1e-3));

  // Within the tolerance, but going away, or sliding along: no hit.
  two.motion.displacement.x() = S(0.5);
  EXPECT_EQ(time_of_impact(one, two, {.gap = S(1e-3)}).status, ImpactStatus::Separated);
  two.motion.displacement = Vec3<S>(0, 0, 0);
  EXPECT_EQ(time_of_impact(one, two, {.gap = S(1e-3)}).status, ImpactStatus::Separated);
}

/// B's lowest point over the plane, metres.
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

/// A plane may turn as well: no point of B, however it is seen, goes through it unnoticed.
TYPED_TEST(TimeOfImpact, SlowPlanesAreAsEveryVertexSays) {
  using S = TypeParam;
  using FindPlane = ImpactResult<S> (*)(const MovingPlane<S>&, const MovingShape<S>&,
                                        const ImpactLimits<S>&, ImpactRun<S>*);
  for (const FindPlane find :
       std::array<FindPlane, 2>{&time_of_impact<S>, &conservative_advancement<S>}) {
    Random random(5);
    int hits = 0, apart = 0, not_near = 0, undecided = 0;
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
      // The very plane is a side of B's start, or nearly.
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
        ++apart;
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
    EXPECT_GT(apart, 50);
    EXPECT_EQ(not_near, 0);
    // What glides past a plane that turns may cost advancement more steps than it has.
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
