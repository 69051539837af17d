#include "dynamics/sleep.h"

#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/scene.h"

namespace contactscope::test {
namespace {

constexpr double kStep = 1.0 / 60.0;

/// A floor, number 0, and `count` balls of a metre in a row, none of them moving.
Scene<double> balls(int count) {
  Scene<double> scene;
  scene.add_plane();
  for (int i = 0; i < count; ++i) scene.add_sphere(0.5, {1.0 * i, 0.5, 0}, 1 + i);
  scene.settings.sleep_after = 0.5;
  scene.settings.sleep_speed = 0.05;
  return scene;
}

/// Calls settle until half a second has passed.
void rest(Sleepers<double>& sleepers, std::vector<Body<double>>& bodies,
          const std::vector<Touch>& touches) {
  for (int i = 0; i < 31; ++i) sleepers.settle(bodies, touches, kStep);
}

TEST(Islands, AreNamedByTheirLowestBodyInAnyOrderOfJoins) {
  Islands islands(7);
  islands.join(5, 6);
  islands.join(2, 5);
  islands.join(4, 6);
  islands.join(1, 3);
  for (const int body : {2, 4, 5, 6}) EXPECT_EQ(islands.of(body), 2) << body;
  EXPECT_EQ(islands.of(0), 0);
  EXPECT_EQ(islands.of(3), 1);
}

TEST(Sleepers, BodiesSleepOnlyIfEnabled) {
  Scene<double> scene = balls(1);
  scene.settings.sleep_after.reset();
  Sleepers<double> sleepers(scene.world.bodies, scene.settings);
  EXPECT_FALSE(sleepers.may_sleep());
  rest(sleepers, scene.world.bodies, {});
  EXPECT_FALSE(sleepers.asleep(1));
}

TEST(Sleepers, ABodySleepsAfterTheTimeForWhichItWasSlow) {
  Scene<double> scene = balls(1);
  Sleepers<double> sleepers(scene.world.bodies, scene.settings);
  scene.body(1).velocity = {0.049, 0, 0};
  for (int i = 0; i < 29; ++i) sleepers.settle(scene.world.bodies, {}, kStep);
  EXPECT_FALSE(sleepers.asleep(1));
  for (int i = 0; i < 2; ++i) sleepers.settle(scene.world.bodies, {}, kStep);
  EXPECT_TRUE(sleepers.asleep(1));
  EXPECT_TRUE(scene.body(1).velocity.isZero(0));
}

TEST(Sleepers, AFastFrameResetsTheTimer) {
  Scene<double> scene = balls(1);
  Sleepers<double> sleepers(scene.world.bodies, scene.settings);
  for (int i = 0; i < 60; ++i) {
    scene.body(1).velocity = {i % 25 == 24 ? 0.051 : 0.0, 0, 0};
    sleepers.settle(scene.world.bodies, {}, kStep);
  }
  EXPECT_FALSE(sleepers.asleep(1));
}

// A ball of radius r spinning at w has the inertia 0.4 m r^2: it counts as moving at sqrt(0.4) w r.
TEST(Sleepers, SpinCountsAsItsEnergyDoes) {
  Scene<double> scene = balls(1);
  scene.body(1).angular_velocity = {0, 0.1, 0};
  EXPECT_NEAR(mean_speed(scene.body(1)), std::sqrt(0.4) * 0.1 * 0.5, 1e-15);
  scene.body(1).velocity = {0.03, 0, 0};
  EXPECT_NEAR(mean_speed(scene.body(1)), std::hypot(std::sqrt(0.4) * 0.1 * 0.5, 0.03), 1e-15);
}

TEST(Sleepers, OneThatMovesKeepsItsWholeIslandAwakeAndNoOther) {
  Scene<double> scene = balls(5);
  Sleepers<double> sleepers(scene.world.bodies, scene.settings);
  const std::vector<Touch> touches{{0, 1}, {1, 2}, {2, 3}, {4, 5}, {0, 4}, {0, 5}};
  scene.body(3).velocity = {0, 1, 0};
  rest(sleepers, scene.world.bodies, touches);
  for (const int body : {1, 2, 3}) EXPECT_FALSE(sleepers.asleep(body)) << body;
  for (const int body : {4, 5}) EXPECT_TRUE(sleepers.asleep(body)) << body;
}

TEST(Sleepers, AnIslandWakesAsAWholeWhenOneThatIsAwakeTouchesIt) {
  Scene<double> scene = balls(5);
  Sleepers<double> sleepers(scene.world.bodies, scene.settings);
  std::vector<Touch> touches{{0, 1}, {1, 2}, {2, 3}, {0, 4}};
  scene.body(5).velocity = {0, 1, 0};
  rest(sleepers, scene.world.bodies, touches);
  EXPECT_FALSE(sleepers.wake(scene.world.bodies, touches));
  touches.push_back({3, 5});
  EXPECT_TRUE(sleepers.wake(scene.world.bodies, touches));
  for (const int body : {1, 2, 3}) EXPECT_FALSE(sleepers.asleep(body)) << body;
  EXPECT_TRUE(sleepers.asleep(4)) << "joined by the floor alone";
  // A body that woke must rest as long as the first time.
  sleepers.settle(scene.world.bodies, {}, kStep);
  EXPECT_FALSE(sleepers.asleep(1));
}

TEST(Sleepers, AScriptedBodyWakesItsContactsOnlyIfItMoves) {
  for (const bool spins : {false, true}) {
    Scene<double> scene = balls(2);
    const int lift = scene.add_box({1, 1, 1}, {}, 0);
    Sleepers<double> sleepers(scene.world.bodies, scene.settings);
    const std::vector<Touch> touches{{0, 1}, {2, lift}};
    rest(sleepers, scene.world.bodies, touches);
    EXPECT_FALSE(sleepers.wake(scene.world.bodies, touches));
    (spins ? scene.body(lift).angular_velocity : scene.body(lift).velocity) = {0, 0.01, 0};
    EXPECT_TRUE(sleepers.wake(scene.world.bodies, touches));
    EXPECT_TRUE(sleepers.asleep(1));
    EXPECT_FALSE(sleepers.asleep(2));
  }
}

template <class S> struct Step {
  std::vector<Body<S>> bodies;
  std::vector<PairImpulses<S>> impulses;
};

/// Two stacks of two boxes that lean; `sleepers` null: solve_step.
template <class S>
Step<S> one_step(const Sleepers<S>* sleepers, const std::vector<PairImpulses<S>>& before) {
  Scene<S> scene;
  scene.add_plane();
  for (const double x : {0.0, 5.0}) {
    scene.add_box({0.5, 0.5, 0.5}, at(x, 0.499, 0), 1);
    scene.add_box({0.5, 0.5, 0.5}, at(x + 0.1, 1.498, 0.05), 2);
  }
  scene.world.pairs = pair_all(scene.world.bodies, S(0.6), S(0));
  std::vector<Manifolds<S>> contacts;
  find_contacts(scene.world, scene.shapes, scene.settings, contacts);
  std::vector<PairContacts<S>> pairs;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    pairs.push_back({scene.world.pairs[i].a, scene.world.pairs[i].b, &contacts[i], S(0.6), S(0)});
  Step<S> result{scene.world.bodies, before};
  if (sleepers != nullptr)
    solve_awake<S>(result.bodies, pairs, result.impulses, scene.world.gravity, scene.settings,
                   scene.dt, *sleepers);
  else
    solve_step<S>(result.bodies, pairs, result.impulses, scene.world.gravity, scene.settings,
                  scene.dt);
  return result;
}

template <class S> void expect_same_body(const Body<S>& got, const Body<S>& expected) {
  EXPECT_EQ(got.center, expected.center);
  EXPECT_EQ(got.rotation.coeffs(), expected.rotation.coeffs());
  EXPECT_EQ(got.velocity, expected.velocity);
  EXPECT_EQ(got.angular_velocity, expected.angular_velocity);
}

template <class S> void expect_the_awake_are_solved_alike() {
  const Step<S> all = one_step<S>(nullptr, {});
  const Step<S> begin = one_step<S>(nullptr, {});
  Scene<S> scene;
  scene.add_plane();
  for (int i = 0; i < 4; ++i) scene.add_box({0.5, 0.5, 0.5}, {}, 1);
  scene.settings.sleep_after = 0;
  Sleepers<S> sleepers(scene.world.bodies, scene.settings);
  const Step<S> no_record = one_step<S>(&sleepers, {});
  for (std::size_t i = 0; i < all.bodies.size(); ++i)
    expect_same_body(no_record.bodies[i], all.bodies[i]);

  // The first stack sleeps and keeps its impulses. The second is solved as if none slept.
  std::vector<Body<S>> bodies = scene.world.bodies;
  for (const int i : {3, 4}) at(bodies, i).velocity = {S(0), S(9), S(0)};
  sleepers.settle(bodies, {}, kStep);
  ASSERT_TRUE(sleepers.asleep(1) && sleepers.asleep(2) && !sleepers.asleep(3));
  const Step<S> half = one_step<S>(&sleepers, begin.impulses);
  const Step<S> warm = one_step<S>(nullptr, begin.impulses);
  for (const std::size_t i : {3u, 4u}) expect_same_body(half.bodies[i], warm.bodies[i]);
  for (const std::size_t i : {1u, 2u}) EXPECT_TRUE(half.bodies[i].velocity.isZero(S(0)));
  // Pairs in order: 0-1, 0-2, 0-3, 0-4, 1-2, ...
  for (const std::size_t pair : {0u, 4u}) {
    ASSERT_EQ(half.impulses[pair].size(), 4u);
    EXPECT_EQ(half.impulses[pair][0].total_normal, begin.impulses[pair][0].total_normal);
  }
  EXPECT_EQ(half.impulses[2][0].total_normal, warm.impulses[2][0].total_normal);
}

TEST(SolveAwake, GivesTheBitsOfSolveStepToAllThatAreAwake) {
  expect_the_awake_are_solved_alike<float>();
  expect_the_awake_are_solved_alike<double>();
}

}  // namespace
}  // namespace contactscope::test
