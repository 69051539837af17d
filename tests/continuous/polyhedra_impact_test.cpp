// Polyhedra, which time_of_impact() casts against each other before it measures a distance.
#include <gmock/gmock.h>

#include <cstring>
#include <numbers>

#include "continuous/moving_pair.h"
#include "geometry/primitives.h"

namespace contactscope {
namespace {

using namespace test;

template <class S> class PolyhedraImpact : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(PolyhedraImpact, Scalars);

/// Boxes and hulls, and segments and points without a radius.
MovingPair<double> random_polyhedra(Random& random, double size, double most_turn) {
  int vertices = 4 + random.index(28);
  MovingPair<double> pair = random_moving_pair(random, size, most_turn, vertices);
  pair.radius_a = pair.radius_b = 0;
  return pair;
}

TYPED_TEST(PolyhedraImpact, SlowEverySizeMatchesExhaustion) {
  Random random(21);
  Tally tally;
  constexpr int kPairs = 200;
  for (int i = 0; i < kPairs; ++i) {
    const double size = random.decade(-4, 4);
    const double turn = random.chance(0.5) ? random.decade(-3, 1) : 0;
    judge<TypeParam>(&time_of_impact<TypeParam>, random_polyhedra(random, size, turn), tally);
  }
  expect_right(tally, kPairs);
}

TYPED_TEST(PolyhedraImpact, SlowFarFromTheOriginNothingIsLost) {
  Random random(22);
  Tally tally;
  constexpr int kPairs = 120;
  for (int i = 0; i < kPairs; ++i) {
    MovingPair<double> pair = random_polyhedra(random, 0.5, random.chance(0.5) ? 2 : 0);
    const Vec3d away = (random.chance(0.5) ? 1e3 : 1e4) * random.unit_vector();
    for (Sweep<double>* motion : {&pair.motion_a, &pair.motion_b}) motion->start.position += away;
    judge<TypeParam>(&time_of_impact<TypeParam>, pair, tally);
  }
  expect_right(tally, kPairs);
}

/// Paths of a hundred sizes in one step, and spins about a far pivot without other motion.
TYPED_TEST(PolyhedraImpact, SlowLongPathsAndPureSpinsMatchExhaustion) {
  Random random(23);
  Tally tally;
  constexpr int kPairs = 100;
  for (int i = 0; i < kPairs; ++i) {
    MovingPair<double> pair = random_polyhedra(random, 1, 0);
    if (random.chance(0.5)) {
      const Vec3d relative = pair.motion_b.displacement - pair.motion_a.displacement;
      pair.motion_b.displacement = pair.motion_a.displacement + 20 * relative;
      pair.motion_b.start.position -= 10 * relative;
    } else {
      // About A's place: B swings past A or into it.
      pair.motion_a.displacement = pair.motion_b.displacement = Vec3d(3, -2, 1);
      const Vec3d to_a = pair.motion_a.start.position - pair.motion_b.start.position;
      const Vec3d lever = to_a + random.vector(-2, 2);
      pair.motion_b.pivot = pair.motion_b.start.rotation.conjugate() * Vec3d(0.5 * lever);
      const double angle = random.uniform(1, 6);
      pair.motion_b.turn = angle * random.unit_vector();
    }
    judge<TypeParam>(&time_of_impact<TypeParam>, pair, tally);
  }
  EXPECT_EQ(tally.misses + tally.late + tally.not_near + tally.undecided, 0);
  EXPECT_GT(tally.hits, kPairs / 10);
}

/// A bar that spins as it approaches. The casts use its initial rotation; on that path its ends
/// have often passed through the plate. Only the bound over the motion prevents this.
TYPED_TEST(PolyhedraImpact, SlowBarsThatSpinAsTheyComeAreNotLate) {
  Random random(30);
  Tally tally;
  constexpr int kPairs = 120;
  for (int i = 0; i < kPairs; ++i) {
    MovingPair<double> pair;
    pair.core_a.hull = make_box(Vec3d(1, 1, 0.05));
    // Every other one starts so far away that balls about the two are separated.
    const bool is_far = i % 2 == 1;
    const double length = is_far ? 2 : 0.8, height = is_far ? 6 : 1.5;
    pair.core_b.hull = make_box(Vec3d(length, 0.05, 0.05));
    pair.motion_a.start.rotation = random.rotation();
    const Quatd frame = pair.motion_a.start.rotation;
    pair.motion_b.start = {frame * random.rotation(), frame * Vec3d(0.1, 0.2, height)};
    pair.motion_b.displacement = frame * Vec3d(0, 0, -height * random.uniform(0.7, 2));
    const double angle = random.uniform(3, is_far ? 15 : 9);
    pair.motion_b.turn = angle * random.unit_vector();
    judge<TypeParam>(&time_of_impact<TypeParam>, pair, tally);
  }
  expect_right(tally, kPairs);
}

/// Two boxes with half extents of one size, in a frame that is turned and moved. B starts `offset`
/// sizes from A and moves by `shift` sizes.
template <class S> struct BoxPair {
  BoxPair(Random& random, double size, double away, const Vec3d& offset, const Vec3d& shift)
      : box(hull_cast<S>(make_box(Vec3d(size, size, size)))) {
    const Quatd frame = random.rotation();
    const Vec3d origin = away * random.unit_vector();
    a.core = b.core = support_set(box);
    a.motion.start.rotation = b.motion.start.rotation = frame.cast<S>().normalized();
    // From the rounded rotation, so that faces are parallel.
    const Quatd rounded = a.motion.start.rotation.template cast<double>();
    a.motion.start.position = origin.cast<S>();
    b.motion.start.position = a.motion.start.position + (rounded * (size * offset)).cast<S>();
    b.motion.displacement = (rounded * (size * shift)).cast<S>();
  }

  Hull<S> box;
  MovingShape<S> a, b;
};

TYPED_TEST(PolyhedraImpact, FacesThatMeetFlatMeetWhenTheGapIsGone) {
  using S = TypeParam;
  Random random(24);
  for (int i = 0; i < 200; ++i) {
    const double size = random.decade(-4, 4);
    const double x = random.uniform(-1.5, 1.5), y = random.uniform(-1.5, 1.5);
    BoxPair<S> pair(random, size, 0, {x, y, 5}, {0, 0, -6});
    const ImpactResult<S> found = time_of_impact(pair.a, pair.b);
    ASSERT_EQ(found.status, ImpactStatus::Hit) << i;
    EXPECT_LE(static_cast<double>(found.time), 0.5 + 1e-6);
    EXPECT_NEAR(static_cast<double>(found.time), 0.5, 1e-4);
    const Vec3<S> up = pair.a.motion.start.rotation * Vec3<S>::UnitZ();
    EXPECT_NEAR(static_cast<double>(found.normal.dot(up)), 1, 1e-5);
    EXPECT_LE(found.steps, 1);
  }
}

TYPED_TEST(PolyhedraImpact, ParallelFacesThatSlideDoNotMeet) {
  using S = TypeParam;
  Random random(25);
  for (int i = 0; i < 200; ++i) {
    const double size = random.decade(-4, 4);
    // The tolerance is a hundredth: within it from the start, or outside it throughout.
    for (const double gap : {0.005, 0.02}) {
      BoxPair<S> pair(random, size, 0, {0.5, 0.3, 2 + gap}, {6, -8, 0});
      const ImpactResult<S> found = time_of_impact(pair.a, pair.b, {.of_motion = S(1e-3)});
      EXPECT_EQ(found.status, ImpactStatus::Separated) << i << ' ' << gap;
      EXPECT_EQ(found.time, S(1));
    }
  }
}

/// Passing with or without clearance: a difference of ten tolerances is detected for certain.
TYPED_TEST(PolyhedraImpact, GrazesAreDistinguishedFromMisses) {
  using S = TypeParam;
  Random random(26);
  for (int i = 0; i < 300; ++i) {
    const double size = random.decade(-4, 4), away = random.chance(0.3) ? 2e3 * size : 0;
    // Coordinates so far away lose half a rounding in advance.
    const double room =
        3e-3 + 8 * static_cast<double>(std::numeric_limits<S>::epsilon()) * away / size;
    const double y = random.uniform(-1.5, 1.5);
    BoxPair<S> passes(random, size, away, {-5, y, 2 + room}, {10, 0, 0});
    EXPECT_EQ(time_of_impact(passes.a, passes.b).status, ImpactStatus::Separated) << i;
    BoxPair<S> grazes(random, size, away, {-5, y, 2 - room}, {10, 0, 0});
    const ImpactResult<S> found = time_of_impact(grazes.a, grazes.b);
    ASSERT_EQ(found.status, ImpactStatus::Hit) << i;
    EXPECT_NEAR(static_cast<double>(found.time), 0.3, 1e-3) << i;
    EXPECT_LE(static_cast<double>(found.time), 0.3 + 0.1 * room) << i;
    // An edge past an edge; the path crosses both.
    BoxPair<S> edges(random, size, away, {-5, 2 + room, 2 + room}, {10, 0, 0});
    EXPECT_EQ(time_of_impact(edges.a, edges.b).status, ImpactStatus::Separated) << i;
  }
}

TYPED_TEST(PolyhedraImpact, OverlapAndHitAtTheStartDiffer) {
  using S = TypeParam;
  Random random(27);
  for (int i = 0; i < 100; ++i) {
    const double size = random.decade(-4, 4);
    const auto found = [&](double z, double shift, double until = 1) {
      BoxPair<S> pair(random, size, 0, {0.3, 0.2, z}, {0.1, 0, shift});
      return time_of_impact(pair.a, pair.b, {.of_motion = S(1e-3), .until = static_cast<S>(until)});
    };
    EXPECT_EQ(found(1.99, 1).status, ImpactStatus::Overlapping);
    EXPECT_EQ(found(2, 1).status, ImpactStatus::Overlapping);
    EXPECT_EQ(found(2.0005, 1).status, ImpactStatus::Separated);
    const ImpactResult<S> soon = found(2.0005, -1);
    EXPECT_EQ(soon.status, ImpactStatus::Hit);
    EXPECT_GT(soon.time, S(0));
    EXPECT_LT(static_cast<double>(soon.time), 0.0005);
    EXPECT_EQ(found(3, -2).status, ImpactStatus::Hit);
    const ImpactResult<S> later = found(3, -2, 0.4);
    EXPECT_EQ(later.status, ImpactStatus::Separated);
    EXPECT_EQ(later.time, S(0.4));
    EXPECT_EQ(found(3, 1e-12).status, ImpactStatus::Separated);
  }
}

/// A hit reports a point on the surface of each shape at the reported distance, and a normal along
/// which the shapes are separated.
TYPED_TEST(PolyhedraImpact, PointsLieOnTheShapesAndTheNormalSeparatesThem) {
  using S = TypeParam;
  Random random(28);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const double turn = random.chance(0.5) ? 2 : 0;
    const MovingPair<double> exact = random_polyhedra(random, 1, turn);
    const MovingPair<S> pair = exact.template cast<S>();
    const MovingPair<double> given = pair.template cast<double>();
    const ImpactResult<S> found = time_of_impact(pair.a(), pair.b());
    if (found.status != ImpactStatus::Hit) continue;
    ++hits;
    const double rounding = least_tolerance<S>(given) / 4;
    const auto time = static_cast<double>(found.time);
    const Vec3d normal = found.normal.template cast<double>();
    const auto reach = [&](const Core<double>& core, const Sweep<double>& motion, double sign) {
      double most = -std::numeric_limits<double>::infinity();
      for (const Vec3d& point : core.hull ? core.hull->vertices : core.points)
        most = std::max(most, sign * normal.dot(placed(motion, time).transform(point)));
      return most;
    };
    const double between =
        -reach(given.core_b, given.motion_b, -1) - reach(given.core_a, given.motion_a, 1);
    EXPECT_GT(between, 0);
    EXPECT_NEAR(between, static_cast<double>(found.distance), 4e-5 * most_motion(given) + rounding);
    const Vec3d on_a = found.on_a.template cast<double>(),
                on_b = found.on_b.template cast<double>();
    EXPECT_NEAR((on_b - on_a).norm(), static_cast<double>(found.distance), rounding);
    const auto off = [&](const Vec3d& point, const Core<double>& core,
                         const Sweep<double>& motion) {
      const Features at_point = features_of_point(point, Pose<double>());
      return static_cast<double>(
          brute_force_distance(at_point, features_at(core, placed(motion, time))).distance);
    };
    EXPECT_LT(off(on_a, given.core_a, given.motion_a), rounding);
    EXPECT_LT(off(on_b, given.core_b, given.motion_b), rounding);
  }
  EXPECT_GT(hits, 100);
}

/// Recording contains the whole path in safe steps, and changes no bit.
TYPED_TEST(PolyhedraImpact, RecordedStepsLeadToTheSameResult) {
  using S = TypeParam;
  Random random(29);
  int steps = 0;
  for (int i = 0; i < 60; ++i) {
    const double turn = random.chance(0.5) ? 2 : 0;
    const MovingPair<double> exact = random_polyhedra(random, 1, turn);
    const MovingPair<S> pair = exact.template cast<S>();
    ImpactRun<S> run;
    const ImpactResult<S> watched = time_of_impact<S>(pair.a(), pair.b(), {}, &run);
    const ImpactResult<S> found = time_of_impact<S>(pair.a(), pair.b());
    EXPECT_EQ(watched.status, found.status);
    EXPECT_EQ(watched.time, found.time);
    EXPECT_EQ(watched.distance, found.distance);
    EXPECT_EQ(watched.normal, found.normal);
    EXPECT_EQ(watched.on_a, found.on_a);
    EXPECT_EQ(watched.on_b, found.on_b);
    S reached = 0;
    for (const ImpactStep<S>& step : run.steps) {
      EXPECT_GE(step.time, reached);
      EXPECT_GE(step.safe, step.time);
      EXPECT_GE(step.bracket_end, step.safe);
      EXPECT_NEAR(static_cast<double>(step.axis.norm()), 1, 1e-5);
      reached = step.safe;
      ++steps;
    }
    EXPECT_LE(reached, std::max(found.time, S(1)));
  }
  EXPECT_GT(steps, 60);
}

}  // namespace
}  // namespace contactscope
