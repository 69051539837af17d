#include "versus/rollout.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

/// Scores of rollouts whose motion is known in advance.
namespace contactscope::versus {
namespace {

constexpr double kG = 10, kStep = 0.01;

trace::Shape ball(const std::string& name, double radius) {
  trace::Shape shape;
  shape.name = name;
  shape.type = "sphere";
  shape.vertices = {Vec3d::Zero()};
  shape.radius = radius;
  return shape;
}

trace::Shape ground() {
  trace::Shape shape;
  shape.name = "ground";
  shape.type = "plane";
  shape.half_space = trace::HalfSpace{};
  return shape;
}

/// Balls of 1 kg and 1 m in diameter at these places above the ground, and `frames` frames.
trace::Trace request_of_balls(const std::vector<Vec3d>& places, int frames) {
  trace::Trace request;
  request.header.scalar = "double";
  request.header.up = "y";
  request.header.world = trace::World{{0, -kG, 0}, kStep};
  request.header.shapes = {ground()};
  for (int k = 0; k < frames; ++k) {
    trace::Frame& frame = request.frames.emplace_back();
    frame.frame = k;
    frame.time = k * kStep;
  }
  trace::Frame& start = request.frames.front();
  start.poses.emplace_back("ground", Pose<double>{});
  start.solver.emplace();
  for (int i = 0; i < count_of(places); ++i) {
    const std::string name = "ball" + std::to_string(i);
    request.header.shapes.push_back(ball(name, 0.5));
    start.poses.emplace_back(name, Pose<double>{Quatd::Identity(), at(places, i)});
    trace::Body& body = start.solver->bodies.emplace_back();
    body.name = name;
    body.mass = 1;
    body.center_of_mass = at(places, i);
    body.inertia = {0.1 * Vec3d::UnitX(), 0.1 * Vec3d::UnitY(), 0.1 * Vec3d::UnitZ()};
  }
  return request;
}

using Path = Pose<double> (*)(int ball, int frame);

EngineRun moved(const trace::Trace& request, Path path, bool has_velocities = false) {
  EngineRun engine_run{"it", "", "", "", "", {}};
  engine_run.trace.header = request.header;
  for (const trace::Frame& requested : request.frames) {
    trace::Frame& frame = engine_run.trace.frames.emplace_back();
    frame.frame = requested.frame;
    const int bodies = count_of(request.frames.front().solver->bodies);
    for (int i = 0; i < bodies; ++i)
      frame.poses.emplace_back("ball" + std::to_string(i), path(i, requested.frame));
    if (has_velocities) frame.solver = request.frames.front().solver;
  }
  return engine_run;
}

Pose<double> at_height(double height) { return {Quatd::Identity(), {0, height, 0}}; }

/// Semi-implicit Euler loses m g^2 dt^2 / 2 of energy a step: y = y0 - g dt^2 k (k + 1) / 2.
TEST(Rollout, AFreeFallGainsNoEnergy) {
  const trace::Trace request = request_of_balls({{0, 10, 0}}, 100);
  const RolloutScore score =
      judge_rollout(request, moved(request, [](int, int k) {
                      return at_height(10 - kG * kStep * kStep * k * (k + 1) / 2);
                    }));
  EXPECT_EQ(score.failure, "");
  ASSERT_EQ(score.energy.size(), 100u);
  for (int k = 0; k < 100; ++k)
    EXPECT_NEAR(at(score.energy, k), 100 - kG * kG * kStep * kStep * k / 2, 1e-9) << k;
  EXPECT_EQ(score.energy_gained, 0);
  EXPECT_FALSE(score.has_velocities);
  EXPECT_NEAR(score.height.back(), 10 - 0.001 * 99 * 100 / 2, 1e-12);
  EXPECT_EQ(score.resting, 0);  // it is in the air
  EXPECT_TRUE(score.findings.empty());
}

TEST(Rollout, RecordedVelocitiesCount) {
  trace::Trace request = request_of_balls({{0, 10, 0}}, 3);
  request.frames.front().solver->bodies.front().velocity = {3, 0, 0};
  request.frames.front().solver->bodies.front().angular_velocity = {0, 0, 2};
  const auto still = [](int, int) { return at_height(10); };
  EXPECT_NEAR(judge_rollout(request, moved(request, still, true)).energy.back(),
              100 + 4.5 + 0.5 * 0.1 * 4, 1e-12);
  // With differences, only the first frame has the velocity of the start.
  const RolloutScore score = judge_rollout(request, moved(request, still));
  EXPECT_NEAR(score.energy.front(), 104.7, 1e-12);
  EXPECT_NEAR(score.energy.back(), 100, 1e-12);
}

TEST(Rollout, ASpinIsTakenFromThePoses) {
  const trace::Trace request = request_of_balls({{0, 10, 0}}, 3);
  const RolloutScore score = judge_rollout(request, moved(request, [](int, int k) {
                                             Pose<double> pose = at_height(10);
                                             pose.rotation =
                                                 Eigen::AngleAxisd(k * 3 * kStep, Vec3d::UnitX());
                                             return pose;
                                           }));
  EXPECT_NEAR(score.energy.back(), 100 + 0.5 * 0.1 * 9, 1e-9);
  EXPECT_NEAR(score.energy_gained, 0.45, 1e-9);
}

/// The lower ball rests on the ground, the upper one on it; the third hangs next to them.
TEST(Rollout, ASupportedBodyRests) {
  const trace::Trace request = request_of_balls({{0, 0.5, 0}, {0, 1.499, 0}, {1.001, 1.5, 0}}, 2);
  const std::vector<RolloutBody> bodies = rollout_bodies(request);
  ASSERT_EQ(bodies.size(), 3u);
  EXPECT_TRUE(bodies[0].rests);
  EXPECT_TRUE(bodies[1].rests);
  EXPECT_FALSE(bodies[2].rests);  // it touches the upper one from the side
  trace::Trace thrown = request;
  thrown.frames.front().solver->bodies[1].velocity = {0, 1, 0};
  EXPECT_FALSE(rollout_bodies(thrown)[1].rests);
}

TEST(Rollout, ABallThatSinksHasFallen) {
  const trace::Trace request = request_of_balls({{0, 0.5, 0}}, 101);
  const RolloutScore score =
      judge_rollout(request, moved(request, [](int, int k) { return at_height(0.5 - 0.01 * k); }));
  EXPECT_EQ(score.resting, 1);
  EXPECT_EQ(score.fallen, 1);
  ASSERT_TRUE(score.fell_at);
  EXPECT_NEAR(*score.fell_at, 0.51, 1e-9);  // half of its metre, and a step
  EXPECT_EQ(score.first_fallen, "ball0");
  EXPECT_NEAR(score.worst_drift, 1, 1e-12);
  EXPECT_NEAR(score.worst_penetration, 1, 1e-9);
  EXPECT_THAT(score.worst_place, testing::HasSubstr("frame 100"));
}

TEST(Rollout, ABallThatStandsDoesNot) {
  const trace::Trace request = request_of_balls({{0, 0.5, 0}}, 20);
  const RolloutScore score = judge_rollout(
      request, moved(request, [](int, int k) { return at_height(0.5 - 1e-4 * std::min(k, 10)); }));
  EXPECT_EQ(score.fallen, 0);
  EXPECT_NEAR(score.worst_drift, 1e-3, 1e-12);
  EXPECT_NEAR(score.penetration.back(), 1e-3, 1e-9);
}

/// 3.4 m a frame: in no frame does the bullet overlap the ball at 5 m. A bullet that stops in the
/// ball does not pass it, and neither does one that flies by at a distance.
TEST(Rollout, ABallThatPassesThroughAnotherIsSeen) {
  const trace::Trace request = request_of_balls({{0, 5, 0}, {5, 5, 0}}, 4);
  const auto flown = [&](Path path) { return judge_rollout(request, moved(request, path)); };
  const RolloutScore through = flown([](int i, int k) {
    return Pose<double>{Quatd::Identity(), {i == 0 ? 3.4 * k : 5.0, 5, 0}};
  });
  EXPECT_EQ(through.worst_penetration, 0);
  EXPECT_EQ(through.passed, 1);
  EXPECT_EQ(through.first_passed, "frame 2, ball0-ball1");
  const RolloutScore stopped = flown([](int i, int k) {
    return Pose<double>{Quatd::Identity(), {i == 0 ? std::min(3.4 * k, 4.0) : 5.0, 5, 0}};
  });
  EXPECT_EQ(stopped.passed, 0);
  const RolloutScore shifted = flown([](int i, int k) {
    return Pose<double>{Quatd::Identity(), {i == 0 ? 3.4 * k : 5.0, i == 0 ? 6.05 : 5.0, 0}};
  });
  EXPECT_EQ(shifted.passed, 0);
}

/// Frames after one with a missing or non-finite body are not judged.
TEST(Rollout, ABodyThatIsLostEndsTheJudging) {
  const trace::Trace request = request_of_balls({{0, 0.5, 0}}, 10);
  const auto still = [](int, int) { return at_height(0.5); };
  EngineRun lost = moved(request, still);
  lost.trace.frames[4].poses.clear();
  EXPECT_EQ(judge_rollout(request, lost).failure, "frame 4 has no pose of 'ball0'");
  EXPECT_EQ(judge_rollout(request, lost).time.size(), 4u);
  EngineRun nowhere = moved(request, still);
  nowhere.trace.frames[6].poses.front().second.position.y() =
      std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judge_rollout(request, nowhere).failure, "frame 6 has an invalid pose of 'ball0'");
  EXPECT_EQ(judge_rollout(request, nowhere).penetration.size(), 6u);
}

TEST(Rollout, ARefusalIsHandedOn) {
  const trace::Trace request = request_of_balls({{0, 0.5, 0}}, 2);
  EngineRun refusing{"it", "", "", "", "", {}};
  refusing.refusal = "it steps nothing";
  EXPECT_EQ(judge_rollout(request, refusing).refusal, "it steps nothing");
}

}  // namespace
}  // namespace contactscope::versus
