#include "dynamics/solver.h"

#include <gmock/gmock.h>

#include "dynamics/constraint.h"
#include "dynamics/scene.h"
#include "support/random_geometry.h"

namespace contactscope::test {
namespace {

struct Method {
  const char* name;
  PositionCorrection correction;
  int substeps;
};
std::ostream& operator<<(std::ostream& out, const Method& method) { return out << method.name; }

class EveryMethod : public ::testing::TestWithParam<Method> {
 protected:
  Scene<double> scene() const {
    Scene<double> result;
    result.settings.position_correction = GetParam().correction;
    result.settings.substeps = GetParam().substeps;
    return result;
  }
};
INSTANTIATE_TEST_SUITE_P(Solver, EveryMethod,
                         ::testing::Values(Method{"Baumgarte", PositionCorrection::Baumgarte, 1},
                                           Method{"Projection", PositionCorrection::Projection, 1},
                                           Method{"Soft", PositionCorrection::Soft, 4}),
                         [](const ::testing::TestParamInfo<Method>& test) {
                           return std::string(test.param.name);
                         });

/// Downhill velocity after `seconds` of a flat box on a slope of `degrees`.
double slide(Scene<double> scene, double degrees, double friction, double seconds) {
  scene.friction = friction;
  scene.settings.slop = 0.001;
  scene.settings.iterations = 20;
  const Quatd turn = about(Vec3d::UnitZ(), -degrees * kDegree);
  scene.add_plane(-degrees * kDegree);
  const int box = scene.add_box({0.5, 0.1, 0.5}, {turn, turn * Vec3d(0, 0.099, 0)}, 3);
  scene.advance(static_cast<int>(std::lround(seconds / scene.dt)));
  return scene.body(box).velocity.dot(turn * Vec3d::UnitX());
}

// Holds if tan(angle) <= mu, slides with g (sin - mu cos) if it is steeper.
TEST_P(EveryMethod, SlowABoxHoldsBelowTheAngleOfFrictionAndSlidesAbove) {
  for (const double friction : {0.2, 0.5, 0.8}) {
    const double critical = std::atan(friction) / kDegree;
    EXPECT_NEAR(slide(scene(), critical - 1, friction, 1), 0, 1e-6) << friction;
    EXPECT_NEAR(slide(scene(), critical / 3, friction, 1), 0, 1e-6) << friction;
    for (const double angle : {critical + 2, critical + 15}) {
      const double acceleration =
          kGravity * (std::sin(angle * kDegree) - friction * std::cos(angle * kDegree));
      const double gained =
          slide(scene(), angle, friction, 0.75) - slide(scene(), angle, friction, 0.25);
      EXPECT_NEAR(gained, 0.5 * acceleration, 0.005 * 0.5 * acceleration)
          << friction << " at " << angle << " degrees";
    }
  }
}

// The correction must not lift a body off the friction that holds it: at default settings, up to a
// tenth of a degree below the critical angle.
TEST_P(EveryMethod, ABoxThatHoldsDoesNotCreep) {
  const double friction = 0.5, critical = std::atan(friction) / kDegree;
  for (const double degrees : {10.0, critical - 1, critical - 0.1}) {
    Scene<double> slope = scene();
    slope.friction = friction;
    const Quatd turn = about(Vec3d::UnitZ(), -degrees * kDegree);
    slope.add_plane(-degrees * kDegree);
    const Vec3d start = turn * Vec3d(0, 0.1, 0);
    const int box = slope.add_box({0.5, 0.1, 0.5}, {turn, start}, 3);
    slope.advance(30);
    const Vec3d at_rest = slope.body(box).center;
    EXPECT_LT((at_rest - start).norm(), 0.005) << degrees;
    slope.advance(270);
    // Soft contacts keep sinking for a while.
    const double creep = GetParam().correction == PositionCorrection::Soft ? 5e-4 : 1e-5;
    EXPECT_LT((slope.body(box).center - at_rest).norm(), creep) << degrees;
  }
}

// Without slip a ball rolls with g sin / (1 + 2/5).
TEST_P(EveryMethod, ABallRollsDownASlope) {
  Scene<double> rolling = scene();
  rolling.settings.slop = 0.0001;  // shortens the lever arm relative to the radius
  const double angle = 20 * kDegree;
  const Quatd turn = about(Vec3d::UnitZ(), -angle);
  rolling.add_plane(-angle);
  const int ball = rolling.add_sphere(0.25, turn * Vec3d(0, 0.2499, 0), 2);
  rolling.advance(60);
  const double gained = kGravity * std::sin(angle) / 1.4;
  const double share = 0.002;
  EXPECT_NEAR(rolling.body(ball).velocity.dot(turn * Vec3d::UnitX()), gained, share * gained);
  EXPECT_NEAR(rolling.body(ball).angular_velocity.z(), -gained / 0.25, share * gained / 0.25);
}

TEST_P(EveryMethod, SlowSlidingHasNoPreferredDirection) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (int i = 0; i < 24; ++i) {
    Scene<double> level = scene();
    level.friction = 0.3;
    level.settings.slop = 0.001;
    level.settings.speculative_margin = 0.01;
    level.add_plane();
    const int ball = level.add_box({0.1, 0.1, 0.1}, at(0, 0.099, 0), 1);
    const Vec3d direction(std::cos(i * 15 * kDegree), 0, std::sin(i * 15 * kDegree));
    level.body(ball).rotation = about(Vec3d::UnitY(), -i * 15 * kDegree);
    level.body(ball).velocity = 3 * direction;
    level.advance(60);
    const double offset = level.body(ball).center.dot(direction);
    EXPECT_LT((level.body(ball).center - offset * direction - Vec3d(0, 0.1, 0)).norm(), 0.002);
    least = std::min(least, offset);
    most = std::max(most, offset);
  }
  // v^2 / (2 mu g) = 1.53 m, give or take half a step at the start and at the end.
  EXPECT_NEAR(most, 9 / (2 * 0.3 * kGravity), 0.03);
  EXPECT_LT(most - least, 1e-9);
}

/// Heights above a floor at which a body's bounces end after a fall from 2 m, measured at its
/// lowest point, `half` below its centre.
std::vector<double> tops(Scene<double> scene, int body, double half, double seconds) {
  std::vector<double> result;
  double last = scene.body(body).center.y() - half, before_last = last;
  for (double time = 0; time < seconds; time += scene.dt) {
    scene.advance();
    const double height = scene.body(body).center.y() - half;
    if (last > before_last && last >= height) result.push_back(last);
    before_last = std::exchange(last, height);
  }
  return result;
}

// Steps follow a parabola of their own; a frame can miss its top by g dt^2 / 8. Otherwise no height
// is gained or lost, however late or early the ball is met and lifted out.
TEST_P(EveryMethod, AnElasticBallComesBackToItsHeight) {
  for (const bool margin : {false, true}) {
    for (const double dt : {1.0 / 60, 1.0 / 200}) {
      for (const double restitution : {1.0, 0.8}) {
        Scene<double> level = scene();
        level.dt = dt;
        level.restitution = restitution;
        if (margin) level.settings.speculative_margin = 0.5;
        level.add_plane();
        const int ball = level.add_sphere(0.25, {0, 2.25, 0}, 2);
        const std::vector<double> found = tops(level, ball, 0.25, 6);
        ASSERT_GE(found.size(), 4u);
        for (std::size_t i = 0; i < found.size(); ++i) {
          const double height = 2 * std::pow(restitution, 2.0 * static_cast<double>(i + 1));
          if (height < 0.2) break;
          // Met late, the ball has gained speed and loses that share; met early, it waits.
          const double late = (1 - restitution) * 2 * 6.3 * dt;
          EXPECT_LT(found[i], height + 0.0005 + 0.2 * late) << i << ", " << restitution;
          EXPECT_GT(found[i], height - 0.0005 - late) << i << ", " << restitution;
        }
      }
    }
  }
}

TEST_P(EveryMethod, AnElasticBoxBouncesLevel) {
  Scene<double> level = scene();
  level.restitution = 1;
  level.add_plane();
  const int box = level.add_box({0.25, 0.25, 0.25}, at(0, 2.25, 0), 2);
  const std::vector<double> found = tops(level, box, 0.25, 6);
  ASSERT_GE(found.size(), 4u);
  for (const double top : found) EXPECT_NEAR(top, 2, 0.0005);
}

TEST(Restitution, IsTheShareOfTheVelocityThatComesBack) {
  for (const double restitution : {0.25, 0.5, 0.75, 1.0}) {
    Scene<double> scene;
    scene.restitution = restitution;
    scene.settings.iterations = 100;
    scene.world.gravity.setZero();
    scene.add_plane();
    const int box = scene.add_box({0.5, 0.5, 0.5}, at(0, 0.5, 0), 2);
    scene.body(box).velocity = {0, -3, 0};
    scene.advance();
    EXPECT_LT((scene.body(box).velocity - Vec3d(0, 3 * restitution, 0)).norm(), 1e-6);
    EXPECT_LT(scene.body(box).angular_velocity.norm(), 1e-6);
  }
}

/// Upward velocity after a frame of an elastic box that meets the ground at `approach`, including
/// the velocity that gravity adds in the first sub-step.
double rebound(double approach, double dt, int substeps) {
  Scene<double> scene;
  scene.restitution = 1;
  scene.settings.iterations = 100;
  scene.settings.substeps = substeps;
  scene.dt = dt;
  scene.add_plane();
  const int box = scene.add_box({0.5, 0.5, 0.5}, at(0, 0.5, 0), 2);
  scene.body(box).velocity = {0, kGravity * dt / substeps - approach, 0};
  scene.advance();
  return scene.body(box).velocity.y();
}

TEST(Restitution, BeginsAtTwiceWhatGravityAddsInASubStepAtEveryStep) {
  for (const auto& [dt, substeps] : {std::pair{1.0 / 60, 1}, {1.0 / 240, 1}, {1.0 / 60, 4}}) {
    const double threshold = 2 * kGravity * dt / substeps;
    EXPECT_NEAR(rebound(0.95 * threshold, dt, substeps), 0, 0.01 * threshold) << dt;
    // It arrives and rebounds with the speed before gravity's share, and falls in later sub-steps.
    for (const double approach : {1.05 * threshold, 0.6, 3.0}) {
      if (substeps > 1 && approach < 0.5) continue;  // it is back within the frame
      EXPECT_NEAR(rebound(approach, dt, substeps), approach - kGravity * dt, 0.01 * threshold);
    }
  }
}

TEST(Restitution, ARestingBodyDoesNotBounce) {
  Scene<double> scene;
  scene.restitution = 1;
  scene.settings.slop = 0.001;
  scene.add_plane();
  const int box = scene.add_box({0.5, 0.5, 0.5}, at(0, 0.4995, 0), 2);
  for (int i = 0; i < 200; ++i) {
    scene.advance();
    // Less than a hundredth of gravity's share in a step, with which it would bounce.
    ASSERT_LT(scene.body(box).velocity.norm(), 0.01 * kGravity * scene.dt) << i;
  }
}

// Impulses are equal and opposite and act in one point; separated bodies turn more slowly.
TEST_P(EveryMethod, CollisionsKeepBothMomenta) {
  Random random(31);
  int touched = 0;
  for (int round = 0; round < 40; ++round) {
    Scene<double> pile = scene();
    pile.world.gravity.setZero();
    pile.friction = 0.5;
    pile.restitution = 0.25 * (round % 5);
    for (int i = 0; i < 6; ++i) {
      const Pose<double> pose = random.pose(1.2);
      const double mass = random.decade(-1, 2);
      const int body = i % 3 == 0 ? pile.add_sphere(random.uniform(0.3, 0.6), pose.position, mass)
                                  : pile.add(random_hull(random, 12, 0.7, 2), pose, mass);
      pile.body(body).velocity = -2 * pose.position;
      pile.body(body).angular_velocity = 2 * random.unit_vector();
    }
    const auto momenta = [&] {
      Vec3d linear = Vec3d::Zero(), angular = Vec3d::Zero();
      for (const Body<double>& body : pile.world.bodies) {
        linear += body.mass * body.velocity;
        angular += body.mass * body.center.cross(body.velocity) + angular_momentum(body);
      }
      return std::pair(linear, angular);
    };
    const auto [linear, angular] = momenta();
    double size = 0;
    for (const Body<double>& body : pile.world.bodies)
      size += body.mass * body.velocity.norm() + angular_momentum(body).norm();
    for (int i = 0; i < 30; ++i) {
      pile.advance();
      for (const auto& impulses : pile.world.impulses) touched += !impulses.empty();
    }
    EXPECT_LT((momenta().first - linear).norm(), 1e-12 * size) << round;
    EXPECT_LT((momenta().second - angular).norm(), 1e-11 * size) << round;
  }
  EXPECT_GT(touched, 1000);
}

/// Two balls of 1 kg without gravity, overlapping by 2 cm.
Scene<double> two_balls(PositionCorrection correction) {
  Scene<double> scene;
  scene.world.gravity.setZero();
  scene.settings.position_correction = correction;
  scene.settings.slop = scene.settings.speculative_margin = 0;
  scene.add_sphere(0.5, {0, 0, 0}, 1);
  scene.add_sphere(0.5, {0.98, 0, 0}, 1);
  return scene;
}

double gap(Scene<double>& scene) {
  return (scene.body(1).center - scene.body(0).center).norm() - 1;
}

// v_rel = 0.1 / dt * d, and nothing removes it again.
TEST(Correction, BaumgartePushesWithAShareOfTheOverlapAndLeavesThatVelocity) {
  Scene<double> scene = two_balls(PositionCorrection::Baumgarte);
  scene.settings.push_speed = 1;
  scene.advance();
  EXPECT_NEAR(gap(scene), -0.018, 1e-12);
  const double closing = scene.body(1).velocity.x() - scene.body(0).velocity.x();
  EXPECT_NEAR(closing, 0.1 / scene.dt * 0.02, 1e-12);
  scene.advance(20);
  EXPECT_NEAR(gap(scene), -0.02 + 21 * 0.002, 1e-12);
}

TEST(Correction, BaumgarteLeavesNoMoreThanThePushSpeed) {
  for (const double speed : {0.0, 0.03}) {
    Scene<double> scene = two_balls(PositionCorrection::Baumgarte);
    scene.settings.push_speed = speed;
    double overlap = 0.02;
    for (int i = 0; i < 10; ++i) {
      scene.advance();
      overlap -= std::max(0.1 * overlap, speed * scene.dt);
      EXPECT_NEAR(gap(scene), -overlap, 1e-12);
      EXPECT_NEAR(scene.body(1).velocity.x() - scene.body(0).velocity.x(), speed, 1e-12);
    }
  }
}

TEST(Correction, ProjectionCorrectsFullyAtOnceWithoutVelocity) {
  Scene<double> scene = two_balls(PositionCorrection::Projection);
  scene.settings.slop = 0.005;
  scene.advance();
  EXPECT_NEAR(gap(scene), -0.005, 1e-12);
  EXPECT_EQ(scene.kinetic(), 0);
}

TEST(Correction, SoftContactsRelaxWhatTheyPushed) {
  Scene<double> scene = two_balls(PositionCorrection::Soft);
  scene.settings.substeps = 4;
  scene.advance();
  EXPECT_GT(gap(scene), -0.0199);
  EXPECT_LT(gap(scene), 0);
  EXPECT_LT(scene.kinetic(), 1e-20);
}

// A body at rest on a floor loses the same fraction of its overlap in each step.
TEST(Correction, BaumgarteDecaysByTheSameShareInEachStep) {
  Scene<double> scene;
  scene.settings.slop = 0;
  scene.add_plane();
  const int ball = scene.add_sphere(0.5, {0, 0.49, 0}, 1);
  double overlap = 0.01;
  for (int i = 0; i < 60; ++i) {
    scene.advance();
    overlap *= 0.9;
    ASSERT_NEAR(0.5 - scene.body(ball).center.y(), overlap, 1e-9) << i;
  }
}

// A box lies flat in the floor: its corners together lift it by the overlap that each alone has.
TEST(Correction, ProjectionDoesNotLiftABoxHigherThanItsCornersNeed) {
  for (const double tilt : {0.0, 0.01}) {
    Scene<double> scene;
    scene.settings.position_correction = PositionCorrection::Projection;
    scene.settings.iterations = 200;
    scene.settings.slop = 0;
    scene.add_plane();
    scene.add_box({0.5, 0.5, 0.5}, {about({1, 0, 2}, tilt), {0, 0.48, 0}}, 1);
    scene.advance();
    scene.settings.speculative_margin = 0.1;  // also reports separated points
    EXPECT_NEAR(scene.deepest_overlap(), 0, 1e-6);
  }
}

// 80 cm and 20 cm deep: each corner alone would turn the box, all of them together do not.
TEST(Correction, ProjectionTurnsNothingThatLiesLevel) {
  for (const double depth : {0.2, 0.8}) {
    for (const double yaw : {0.0, 0.3, 1.0}) {
      Scene<double> scene;
      scene.settings.position_correction = PositionCorrection::Projection;
      scene.settings.iterations = 30;
      scene.add_plane();
      const Quatd turn = about(Vec3d::UnitY(), yaw);
      const int box = scene.add_box({0.4, 0.6, 0.4}, {turn, {0, 0.6 - depth, 0}}, 10);
      scene.advance(10);
      EXPECT_LT(scene.body(box).rotation.angularDistance(turn), 1e-4) << depth;
      EXPECT_NEAR(scene.body(box).center.y(), 0.6 - 0.004, 1e-4) << depth;
      EXPECT_LT(scene.body(box).velocity.norm(), 1e-3);
    }
  }
}

// A thin wall and a ball that crosses it within one step.
TEST(Speculative, AFastBallIsStoppedByWhatItWouldPass) {
  for (const double margin : {0.0, 3.0}) {
    Scene<double> scene;
    scene.world.gravity.setZero();
    scene.settings.speculative_margin = margin;
    scene.add_box({0.01, 2, 2}, at(0, 0, 0), 0);
    const int ball = scene.add_sphere(0.1, {-1.5, 0, 0}, 1);
    scene.body(ball).velocity = {100, 0, 0};
    scene.advance(2);
    if (margin == 0) {
      EXPECT_GT(scene.body(ball).center.x(), 1);
    } else {
      EXPECT_NEAR(scene.body(ball).center.x(), -0.11, 1e-9);
      EXPECT_NEAR(scene.body(ball).velocity.norm(), 0, 1e-9);
    }
  }
}

TEST(Speculative, ASeparatedPointGetsNoImpulse) {
  Scene<double> scene;
  scene.settings.speculative_margin = 1;
  scene.add_plane();
  const int ball = scene.add_sphere(0.5, {0, 1, 0}, 1);
  scene.advance();
  EXPECT_NEAR(scene.body(ball).velocity.y(), -kGravity / 60, 1e-14);
  EXPECT_EQ(scene.load(0, ball), 0);
}

// A lift that rises at a constant speed carries the bodies on it.
TEST_P(EveryMethod, AScriptedBodyCarriesAndDrags) {
  Scene<double> carried = scene();
  carried.settings.slop = 0.001;
  const int belt = carried.add_box({2, 0.5, 2}, at(0, -0.5, 0), 0);
  const int box = carried.add_box({0.2, 0.2, 0.2}, at(0, 0.199, 0), 5);
  carried.body(belt).velocity = {0.3, 0.5, 0};
  carried.advance(60);
  EXPECT_LT((carried.body(box).velocity - Vec3d(0.3, 0.5, 0)).norm(), 1e-3);
  EXPECT_EQ(carried.body(belt).velocity, Vec3d(0.3, 0.5, 0));
}

TEST(WarmStart, PointsBeginWithWhatTheirIdHadAndNewOnesWithNothing) {
  PairImpulses<double> kept(3);
  kept[0].id = FeatureId::of(edge_ref(Owner::A, 1), edge_ref(Owner::B, 2));
  kept[0].normal = 5;
  kept[0].friction = {1, 7, 2};  // the part along the normal is lost
  kept[1].id = kept[0].id;
  kept[1].normal = 6;
  kept[2].id = FeatureId::of(edge_ref(Owner::A, 1), edge_ref(Owner::B, 3));
  kept[2].triangle = 4;
  kept[2].normal = 7;
  ContactConstraint<double> contact;
  contact.normal = Vec3d::UnitY();
  contact.points.resize(4);
  contact.points[0].id = kept[2].id;  // of no triangle
  contact.points[1].id = kept[0].id;
  contact.points[2].id = kept[0].id;
  contact.points[3].id = kept[0].id;
  recall_impulses(kept, contact, 4);
  std::vector<double> normals;
  for (const ConstraintPoint<double>& point : contact.points)
    normals.push_back(point.normal_impulse);
  EXPECT_THAT(normals, ::testing::ElementsAre(0, 5, 6, 0));
  EXPECT_EQ(contact.points[1].friction_u, 1);
  EXPECT_EQ(contact.points[1].friction_v, 2);
  EXPECT_EQ(contact.points[1].warm_start, 20);
}

}  // namespace
}  // namespace contactscope::test
