#include <set>

#include "lint/recorded.h"

/// Changes over time that are no fault, next to those that are: the same trace with and without.
namespace contactscope::lint {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

std::vector<std::string> found_in(const Trace& trace) { return causes_of(lint(trace)); }

/// The pair of a crate and the one below, counted from the ground; in all frames.
void each_of(Trace& trace, int crate, const std::function<void(int frame, trace::Pair&)>& change) {
  const trace::Pair pair = trace.frames.front().pairs[static_cast<std::size_t>(crate)];
  for (std::size_t f = 0; f < trace.frames.size(); ++f)
    for (trace::Pair& one : trace.frames[f].pairs)
      if (one.a == pair.a && one.b == pair.b) change(static_cast<int>(f), one);
}

void each_point_of(trace::Pair& pair, const std::function<void(trace::Point&)>& change) {
  for (trace::Manifold& manifold : pair.manifolds) std::ranges::for_each(manifold.points, change);
}

/// From frame 15 on nothing moves, and there are no contacts. The bodies are 20 mm lower.
Trace asleep(double stir) {
  Trace trace = stack();
  for (std::size_t f = 15; f < trace.frames.size(); ++f) {
    trace::Frame& frame = trace.frames[f];
    frame.pairs.clear();
    frame.poses = trace.frames[14].poses;
    for (trace::Body& body : frame.solver->bodies) {
      body.velocity = body.angular_velocity = Vec3d::Zero();
      pose_of(frame, body.name).position.y() -= 0.02 + stir * static_cast<double>(f % 2);
    }
  }
  return trace;
}

TEST(LintOverTime, SleepingBodiesHaveNoContacts) {
  EXPECT_THAT(found_in(asleep(0)), IsEmpty());
  EXPECT_THAT(found_in(asleep(1e-6)), Contains("overlap_without_contact"));
}

/// A step is another feature, or a point that was kept. What comes back is a fault.
TEST(LintOverTime, ASeparationThatStepsIsNoFaultUnlessItStepsBack) {
  const auto less = [](int first, int last) {
    Trace trace = stack();
    each_of(trace, 5, [=](int frame, trace::Pair& pair) {
      if (frame >= first && frame <= last)
        each_point_of(pair, [](trace::Point& point) { point.separation -= 1.5e-3; });
    });
    return lint(trace);
  };
  EXPECT_THAT(causes_of(less(12, 100)), IsEmpty());
  const std::vector<Finding> back = less(12, 14);
  ASSERT_THAT(causes_of(back), ElementsAre("depths_jump"));
  EXPECT_EQ(back.front().count, 1);
  EXPECT_EQ(back.front().frame, stack().frames[12].frame);
}

/// Contacts belong to the poses before the step, which are those of the frame before.
TEST(LintOverTime, PosesAfterTheStepAreThoseOfTheNextContacts) {
  Trace trace = heap();
  trace.header.poses_at = "after_step";
  for (std::size_t f = 0; f + 1 < trace.frames.size(); ++f) {
    trace.frames[f].poses = trace.frames[f + 1].poses;
    trace.frames[f].solver = trace.frames[f + 1].solver;
  }
  trace.frames.pop_back();
  EXPECT_THAT(found_in(trace), IsEmpty());
  trace.frames[20].pairs.clear();
  EXPECT_EQ(found_in(trace).front(), "pairs_flicker");
}

TEST(LintOverTime, OfManyPairsThatFlickerTheOneThatDoesMostIsNamed) {
  Trace trace = stack();
  const trace::Pair once = trace.frames.front().pairs[2], most = trace.frames.front().pairs[5];
  for (std::size_t f = 8; f < trace.frames.size(); f += 2)
    std::erase_if(trace.frames[f].pairs, [&](const trace::Pair& pair) {
      return pair.a == (f == 8 ? once.a : most.a) && pair.b == (f == 8 ? once.b : most.b);
    });
  const std::vector<Finding> findings = lint(trace);
  ASSERT_EQ(findings.front().cause, "pairs_flicker");
  EXPECT_EQ(findings.front().a, most.a);
  EXPECT_EQ(findings.front().b, most.b);
  EXPECT_GT(findings.front().frame, trace.frames[8].frame);
}

/// A plate in the ground, on which the lowest crate stands too, by 0.1 mm, and which no pair names.
TEST(LintOverTime, ASmallFindingIsNotBeforeAGrossOne) {
  Trace trace = stack();
  const std::string ground = trace.frames[0].pairs[0].a, crate = trace.frames[0].pairs[0].b;
  trace::Shape plate = *std::ranges::find(trace.header.shapes, crate, &trace::Shape::name);
  const auto [low, high] =
      std::ranges::minmax(plate.vertices, {}, [](const Vec3d& vertex) { return vertex.y(); });
  const double height = high.y() - low.y();
  plate.name = "plate";
  trace.header.shapes.push_back(plate);
  Pose<double> pose = pose_of(trace.frames[0], crate);
  pose.position.y() -= height - 1e-4;
  for (trace::Frame& frame : trace.frames) frame.poses.emplace_back("plate", pose);
  const std::vector<Finding> small = lint(trace);
  ASSERT_THAT(causes_of(small), ElementsAre("pair_never_reported"));
  EXPECT_FALSE(small[0].is_severe);
  EXPECT_EQ(small[0].count, static_cast<int>(trace.frames.size()));
  EXPECT_LT(small[0].size, 1e-3);
  trace.frames[12].pairs.erase(trace.frames[12].pairs.begin() + 5);
  const std::vector<std::string> both = found_in(trace);
  EXPECT_EQ(both.front(), "pairs_flicker");
  EXPECT_EQ(both.back(), "pair_never_reported");
}

TEST(LintOverTime, PointsThatAreThereTwiceExplainTheirImpulses) {
  Trace trace = stack();
  each_of(trace, 5,
          [](int, trace::Pair& pair) { pair.manifolds.push_back(pair.manifolds.front()); });
  EXPECT_THAT(found_in(trace), ElementsAre("points_twice"));
}

TEST(LintOverTime, ImpulsesThatAreMissingInEverySecondFrameFlicker) {
  Trace trace = stack();
  each_of(trace, 5, [](int frame, trace::Pair& pair) {
    if (frame % 2 == 0) return;
    each_point_of(pair, [](trace::Point& point) {
      point.impulse->normal = 0;
      point.impulse->friction = Vec3d::Zero();
    });
  });
  EXPECT_THAT(found_in(trace), ElementsAre("impulses_flicker"));
}

/// The topmost crate is 0.1 mm above the one below, and its pair is missing.
TEST(LintOverTime, ABodyThatNothingHoldsRestsOnTheNearest) {
  Trace trace = stack();
  std::string top;
  each_of(trace, 9, [&](int frame, trace::Pair& pair) {
    double deepest = 0;
    each_point_of(pair, [&](trace::Point& p) { deepest = std::min(deepest, p.separation); });
    top = pair.b;
    pose_of(trace.frames[static_cast<std::size_t>(frame)], top).position.y() += 1e-4 - deepest;
  });
  for (trace::Frame& frame : trace.frames)
    std::erase_if(frame.pairs, [&](const trace::Pair& pair) { return pair.b == top; });
  const std::vector<Finding> findings = lint(trace);
  ASSERT_THAT(causes_of(findings), Contains("pair_never_reported"));
  EXPECT_EQ(findings.front().count, static_cast<int>(trace.frames.size()) - 1);
}

/// Friction of a body that rocks opposes what it does after the step has turned it round.
TEST(LintOverTime, FrictionOpposesSlidingThatContinues) {
  const auto sliding = [](bool rocks) {
    Trace trace = stack();
    each_of(trace, 9, [&](int f, trace::Pair& pair) {
      const Vec3d velocity(rocks && f % 2 == 1 ? -0.5 : 0.5, 0, 0);
      trace::Frame& frame = trace.frames[static_cast<std::size_t>(f)];
      std::ranges::find(frame.solver->bodies, pair.b, &trace::Body::name)->velocity = velocity;
      each_point_of(pair, [&](trace::Point& point) {
        point.impulse->friction = velocity * point.impulse->normal;
      });
    });
    return found_in(trace);
  };
  EXPECT_THAT(sliding(false), Contains("friction_on_a"));
  EXPECT_THAT(sliding(true), Not(Contains("friction_on_a")));
}

/// A tenth of the pairs keep their points for a frame; the others fit the poses of their frame.
TEST(LintOverTime, PointsThatAreKeptAreNotThePosesOfTheFrameBefore) {
  Trace trace = heap();
  for (std::size_t f = trace.frames.size() - 1; f > 0; --f)
    for (std::size_t p = 0; p < trace.frames[f].pairs.size(); p += 10) {
      trace::Pair& pair = trace.frames[f].pairs[p];
      for (const trace::Pair& before : trace.frames[f - 1].pairs)
        if (before.a == pair.a && before.b == pair.b) pair.manifolds = before.manifolds;
    }
  EXPECT_THAT(found_in(trace), Not(Contains("poses_of_frame_before")));
}

/// A body that has fallen off the world falls faster than anything flies; it hides no explosion.
TEST(LintOverTime, BodiesThatFallForeverHideNoneThatFlyOff) {
  Trace trace = heap();
  const std::string falls = trace.frames[0].pairs[0].b, flies = trace.frames[0].pairs[3].b;
  ASSERT_NE(falls, flies);
  for (std::size_t f = 0; f < trace.frames.size(); ++f) {
    trace::Frame& frame = trace.frames[f];
    std::erase_if(frame.pairs,
                  [&](const trace::Pair& pair) { return pair.a == falls || pair.b == falls; });
    pose_of(frame, falls).position.y() = -20 - 0.8 * static_cast<double>(f);
    if (f >= 20) pose_of(frame, flies).position += static_cast<double>(f - 19) * Vec3d(0.5, 1.5, 0);
  }
  const std::vector<Finding> findings = lint(trace);
  const auto found = std::ranges::find(findings, "bodies_fly_off", &Finding::cause);
  ASSERT_NE(found, findings.end());
  EXPECT_EQ(found->a, flies);
}

TEST(LintOverTime, ToleranceThatHidesAllErrorsIsAHint) {
  LintOptions options;
  options.tolerance = 100;
  Linter linter(heap().header, options);
  for (const trace::Frame& frame : heap().frames) linter.frame(frame);
  EXPECT_THAT(causes_of(linter.findings()), Contains("large_tolerance"));
}

TEST(LintOverTime, WhatStandsStillIsNotElsewhereForAFrame) {
  Trace trace = terrain();
  const auto mesh = std::ranges::find(trace.header.shapes, "mesh", &trace::Shape::type);
  ASSERT_NE(mesh, trace.header.shapes.end());
  pose_of(trace.frames[12], mesh->name).position.x() += 0.05;
  const std::vector<Finding> findings = lint(trace);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings.front().cause, "poses_jump");
  EXPECT_EQ(findings.front().a, mesh->name);
}

}  // namespace
}  // namespace contactscope::lint
