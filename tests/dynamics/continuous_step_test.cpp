// Nothing passes through a thin wall between two frames, and slow bodies are not held back.

#include <gtest/gtest.h>

#include "scene.h"
#include "support/random_geometry.h"

namespace contactscope::test {
namespace {

enum class Bullet { Sphere, Box, Rod };
enum class Wall { Box, Triangles, Flying };
constexpr double kHalfWall = 0.005;  // metres

/// A wall across x, 1 cm thick or without thickness, and a bullet that flies at it from the left.
template <class S> struct Shot {
  Scene<S> scene;

  Shot(Bullet bullet, Wall wall, double speed, std::optional<ImpactMethod> method, Random& random) {
    scene.world.gravity.setZero();
    if (wall == Wall::Triangles) {
      const Pose<double> upright{about(Vec3d::UnitZ(), 1.5707963267948966), Vec3d::Zero()};
      scene.add(make_grid(10, 10, 3, 3, 0), upright, 0);
    } else {
      scene.add_box({kHalfWall, 5, 5}, {}, wall == Wall::Flying ? 1000 : 0);
    }
    // Anywhere in the step, so that the wall is hit at all times of it.
    const Vec3d from(-0.6 - random.uniform(0, 1) * std::max(speed / 60, 0.05), 0, 0);
    const Pose<double> pose{random.rotation(), from};
    if (bullet == Bullet::Sphere) scene.add_sphere(0.05, from, 1);
    if (bullet == Bullet::Box) scene.add_box({0.05, 0.05, 0.05}, pose, 1);
    if (bullet == Bullet::Rod) scene.add_box({0.5, 0.02, 0.02}, pose, 1);
    Body<S>& body = scene.body(1);
    body.velocity = Vec3<S>(static_cast<S>(speed), 0, 0);
    if (bullet == Bullet::Rod) {
      const Vec3d spin = 100 * random.unit_vector();
      body.angular_velocity = spin.cast<S>();
    }
    if (wall == Wall::Flying) {
      body.velocity.x() *= S(0.5);
      scene.body(0).velocity.x() = -body.velocity.x();
    }
    const S restitution = random.chance(0.5) ? S(0) : S(0.5);
    scene.world.pairs = pair_all<S>(scene.world.bodies, S(0.3), restitution);
    scene.world.pairs[0].continuous = method;
  }

  /// Whether the middle of the bullet is beyond the middle of the wall.
  bool is_through() {
    const Vec3<S> separation = scene.body(1).center - scene.body(0).center;
    const Vec3<S> normal = scene.world.bodies[0].inverse_mass > S(0)
                               ? Vec3<S>(scene.body(0).rotation * Vec3<S>::UnitX())
                               : Vec3<S>::UnitX();
    return !(separation.dot(normal) < S(0));
  }
};

/// Number of `count` bullets that pass within six frames.
template <class S>
int come_through(Bullet bullet, Wall wall, double speed, std::optional<ImpactMethod> method,
                 int count, Random& random) {
  int through = 0;
  for (int i = 0; i < count; ++i) {
    Shot<S> shot(bullet, wall, speed, method, random);
    bool passed = false;
    for (int frame = 0; frame < 6 && !passed; ++frame) {
      shot.scene.advance();
      passed = shot.is_through();
    }
    through += passed ? 1 : 0;
  }
  return through;
}

template <class S> class Tunnelling : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Tunnelling, Scalars);

TYPED_TEST(Tunnelling, NothingPassesAWallOfACentimetre) {
  Random random(2013);
  for (const ImpactMethod method :
       {ImpactMethod::TimeOfImpact, ImpactMethod::ConservativeAdvancement}) {
    for (const Wall wall : {Wall::Box, Wall::Triangles, Wall::Flying})
      for (const Bullet bullet : {Bullet::Sphere, Bullet::Box, Bullet::Rod})
        for (const double speed : {5.0, 60.0, 300.0, 1000.0})
          EXPECT_EQ(come_through<TypeParam>(bullet, wall, speed, method, 10, random), 0)
              << to_string(method) << ", wall " << static_cast<int>(wall) << ", bullet "
              << static_cast<int>(bullet) << ", " << speed << " m/s";
  }
}

TEST(Tunnelling, WithoutLookingBetweenFramesNearlyAllPass) {
  Random random(7);
  EXPECT_GE(come_through<double>(Bullet::Sphere, Wall::Box, 300, std::nullopt, 50, random), 45);
}

TEST(Tunnelling, SpeculativeContactsStopAStraightFlight) {
  Random random(8);
  EXPECT_EQ(
      come_through<double>(Bullet::Sphere, Wall::Box, 300, ImpactMethod::Speculative, 50, random),
      0);
}

/// After the step, a ball that keeps its speed is as far from the wall as without an interruption.
TEST(ImpactStops, ABallGoesOnForTheRestOfTheStep) {
  Scene<double> scene;
  scene.world.gravity.setZero();
  scene.add_box({kHalfWall, 5, 5}, {}, 0);
  scene.add_sphere(0.05, {-1.055, 0, 0}, 1);
  scene.body(1).velocity = Vec3d(120, 0, 0);  // two metres a step: half of it to the wall
  scene.world.pairs = pair_all<double>(scene.world.bodies, 0, 1);
  scene.world.pairs[0].continuous = ImpactMethod::TimeOfImpact;
  std::vector<Manifolds<double>> contacts;
  const auto stops = step(scene.world, scene.shapes, scene.settings, scene.dt, contacts);
  ASSERT_EQ(stops.size(), 1u);
  EXPECT_EQ(stops[0].a, 0);
  EXPECT_EQ(stops[0].b, 1);
  EXPECT_NEAR(stops[0].time, 0.5, 0.002);
  EXPECT_NEAR(stops[0].normal.x(), -1, 1e-12);
  EXPECT_FALSE(stops[0].for_good);
  EXPECT_NEAR(scene.body(1).velocity.x(), -120, 1e-9);
  EXPECT_NEAR(scene.body(1).center.x(), -1.055, 0.005);
}

/// Bodies that are at rest, or slide or roll without approaching, are never stopped.
TEST(ImpactStops, AStackAndASlidingCrateAreLeftAlone) {
  Scene<float> scene;
  scene.friction = 0.2;
  scene.add_plane();
  for (int i = 0; i < 5; ++i)
    scene.add_box({0.5, 0.5, 0.5}, {Quatd::Identity(), {0, 0.5 + i, 0}}, 1);
  scene.add_box({0.5, 0.5, 0.5}, {Quatd::Identity(), {4, 0.5, 0}}, 1);
  scene.body(6).velocity = Vec3<float>(6, 0, 0);
  scene.world.pairs = pair_all<float>(scene.world.bodies, 0.2f, 0);
  for (WorldPair<float>& pair : scene.world.pairs) pair.continuous = ImpactMethod::TimeOfImpact;
  std::vector<Manifolds<float>> contacts;
  std::size_t stops = 0;
  for (int i = 0; i < 120; ++i)
    stops += step(scene.world, scene.shapes, scene.settings, scene.dt, contacts).size();
  EXPECT_EQ(stops, 0u);
  EXPECT_NEAR(scene.body(5).center.y(), 4.5, 0.05);
}

/// A ball hits the first of two others and stops; that one stops at the second in the same step.
TEST(ImpactStops, APushedBodyIsTestedAgain) {
  Scene<double> scene;
  scene.world.gravity.setZero();
  for (const double x : {0.0, 2.0, 4.0}) scene.add_sphere(0.1, {x, 0, 0}, 1);
  scene.body(0).velocity = Vec3d(600, 0, 0);  // ten metres a step
  scene.world.pairs = pair_all<double>(scene.world.bodies, 0, 1);
  for (WorldPair<double>& pair : scene.world.pairs) pair.continuous = ImpactMethod::TimeOfImpact;
  std::vector<Manifolds<double>> contacts;
  const auto stops = step(scene.world, scene.shapes, scene.settings, scene.dt, contacts);
  ASSERT_EQ(stops.size(), 2u);
  EXPECT_EQ(stops[1].a, 1);
  EXPECT_EQ(stops[1].b, 2);
  EXPECT_GT(stops[1].time, stops[0].time);
  EXPECT_NEAR(scene.body(0).velocity.x(), 0, 1e-9);
  EXPECT_NEAR(scene.body(1).velocity.x(), 0, 1e-9);
  EXPECT_NEAR(scene.body(2).velocity.x(), 600, 1e-9);
  EXPECT_NEAR(scene.body(2).center.x(), 10 + 0.4, 0.02);  // the path is longer by two diameters
}

/// A script drives the wall, at any speed, and the wall carries along the ball in its path.
TEST(ImpactStops, AScriptedWallTakesTheBallAlong) {
  Scene<double> scene;
  scene.world.gravity.setZero();
  scene.add_box({kHalfWall, 5, 5}, {}, 0);
  scene.add_sphere(0.05, {1, 0, 0}, 1);
  scene.world.pairs = pair_all<double>(scene.world.bodies, 0, 0);
  scene.world.pairs[0].continuous = ImpactMethod::TimeOfImpact;
  scene.body(0).velocity = Vec3d(120, 0, 0);
  scene.advance(3);
  EXPECT_GT(scene.body(1).center.x(), scene.body(0).center.x());
  EXPECT_NEAR(scene.body(1).velocity.x(), 120, 1);
}

}  // namespace
}  // namespace contactscope::test
