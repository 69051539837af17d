#include <algorithm>

#include <gmock/gmock.h>

#include "scenario/broken.h"
#include "scenario/run.h"
#include "trace/json.h"

namespace contactscope {
namespace {

using ::testing::HasSubstr;

/// A stack of two crates and one next to it; a third falls onto the latter after about 1.5 seconds.
std::string stacks(const std::string& solver, const std::string& rest = "") {
  const auto crate = [](const std::string& name, const std::string& position,
                        const std::string& more = "") {
    return "[shapes." + name +
           "]\ntype = \"box\"\nhalf_extents = [0.5, 0.5, 0.5]\nposition = " + position +
           "\nmotion = { dynamic = true, mass = 1" + more + " }\n";
  };
  return "title = \"Stacks\"\n[time]\nframes = 240\n" + crate("lower", "[0, 0.5, 0]") +
         crate("upper", "[0.1, 1.5, 0]") + crate("alone", "[4, 0.5, 0]") +
         crate("falling", "[0, 4, 0]", ", velocity = [0, 6, 0]") +
         "[shapes.floor]\ntype = \"plane\"\nnormal = [0, 1, 0]\noffset = 0\n[solver]\n" + solver +
         "\n" + rest;
}

std::vector<std::string> asleep_in(const trace::Frame& frame) {
  std::vector<std::string> names;
  for (const trace::Body& body : frame.solver->bodies)
    if (body.asleep == true) names.push_back(body.name);
  return names;
}

class SleepRun : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(
    Pipelines, SleepRun,
    ::testing::Values("[world]\nbroad_phase = \"tree\"\n", "[pipeline]\nscalar = \"double\"\n",
                      "[pipeline]\nmanifold = \"incremental\"\n",
                      "[pipeline]\nreducer = \"coherent\"\ncontinuous = \"time_of_impact\"\n"),
    [](const ::testing::TestParamInfo<const char*>& test) {
      std::string name = test.param;
      std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
      return name;
    });

TEST_P(SleepRun, ARestingStackSleepsUntilABodyFallsOnIt) {
  const Scenario scenario = parse_scenario(stacks("sleep_after = 0.5", GetParam()), "g/a.toml");
  Runner runner(scenario);
  EXPECT_THAT(asleep_in(runner.frame(20)), ::testing::IsEmpty());
  const trace::Frame sleeping = runner.frame(60);
  EXPECT_THAT(asleep_in(sleeping), ::testing::ElementsAre("lower", "upper", "alone"));
  // A picture shows its contacts, but the step gives them no impulses.
  int touching = 0;
  for (const trace::Pair& pair : sleeping.pairs) {
    touching += pair.state == "touching";
    for (const trace::Manifold& manifold : pair.manifolds)
      for (const trace::Point& point : manifold.points) EXPECT_FALSE(point.impulse);
  }
  EXPECT_EQ(touching, 3);
  int hit = 61;
  while (hit < 240 && asleep_in(runner.frame(hit)).size() == 3) ++hit;
  ASSERT_LT(hit, 130);
  const trace::Frame woken = runner.frame(hit + 1);
  EXPECT_THAT(asleep_in(woken), ::testing::ElementsAre("alone"));
  EXPECT_THAT(asleep_in(runner.frame(239)),
              ::testing::ElementsAre("lower", "upper", "alone", "falling"));
}

TEST_P(SleepRun, SleepersStayWhereTheyAre) {
  const Scenario scenario = parse_scenario(stacks("sleep_after = 0.5", GetParam()), "g/a.toml");
  Runner runner(scenario);
  const trace::Frame before = runner.frame(50), after = runner.frame(70);
  ASSERT_EQ(asleep_in(before).size(), 3u);
  ASSERT_EQ(asleep_in(after).size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(before.poses[i].second.position, after.poses[i].second.position);
    EXPECT_EQ(before.poses[i].second.rotation.coeffs(), after.poses[i].second.rotation.coeffs());
  }
}

TEST_P(SleepRun, AFrameDoesNotDependOnEarlierRequests) {
  const Scenario scenario = parse_scenario(stacks("sleep_after = 0.5", GetParam()), "g/a.toml");
  Runner watched(scenario), skipping(scenario), bare(scenario);
  std::vector<std::string> lines;
  for (int frame = 0; frame < 160; ++frame) {
    lines.push_back(trace::to_json_line(watched.frame(frame)));
    const trace::Frame unwatched = bare.frame_unrecorded(frame);
    ASSERT_EQ(unwatched.poses.size(), 5u);
  }
  for (const int frame : {29, 45, 64, 100, 159}) {
    EXPECT_EQ(trace::to_json_line(skipping.frame(frame)), lines[static_cast<std::size_t>(frame)]);
  }
  Runner went_on = skipping;
  EXPECT_EQ(trace::to_json_line(went_on.frame(200)), trace::to_json_line(bare.frame(200)));
}

// With a threshold that no body falls below, nothing changes.
TEST_P(SleepRun, WithoutARestingBodyNothingChanges) {
  const Scenario sleepless = parse_scenario(stacks("slop = 0.005", GetParam()), "g/a.toml");
  const Scenario restless =
      parse_scenario(stacks("slop = 0.005\nsleep_after = 1000", GetParam()), "g/a.toml");
  Runner expected(sleepless), got(restless);
  for (const int frame : {0, 30, 100, 150}) {
    trace::Frame one = got.frame(frame);
    one.solver->sleep_after.reset();
    one.solver->sleep_speed.reset();
    for (trace::Body& body : one.solver->bodies) {
      EXPECT_EQ(body.asleep, false);
      body.asleep.reset();
    }
    EXPECT_EQ(trace::to_json_line(one), trace::to_json_line(expected.frame(frame)));
  }
}

TEST(SleepRun, AScriptThatStartsMovingWakesTheBodiesOnIt) {
  const Scenario scenario = parse_scenario(
      "title = \"Lift\"\n[time]\nframes = 120\n"
      "[shapes.crate]\ntype = \"box\"\nhalf_extents = [0.5, 0.5, 0.5]\nposition = [0, 1, 0]\n"
      "motion = { dynamic = true, mass = 1 }\n"
      "[shapes.lift]\ntype = \"box\"\nhalf_extents = [1, 0.5, 1]\n"
      "[shapes.lift.motion]\nkeyframes = [{ time = 0, position = [0, 0, 0] }, "
      "{ time = 1, position = [0, 0, 0] }, { time = 1.5, position = [0, -0.5, 0] }]\n"
      "[solver]\nsleep_after = 0.25\n",
      "g/a.toml");
  Runner runner(scenario);
  EXPECT_EQ(asleep_in(runner.frame(59)).size(), 1u);
  EXPECT_EQ(asleep_in(runner.frame(60)).size(), 0u);
  const trace::Frame below = runner.frame(90);
  EXPECT_LT(below.poses[0].second.position.y(), 0.55) << "it went down with the lift";
}

TEST(SleepKeys, AreRead) {
  const Scenario scenario =
      parse_scenario(stacks("sleep_after = 0.25\nsleep_speed = 0.1"), "g/a.toml");
  EXPECT_EQ(scenario.solver.sleep_after, 0.25);
  EXPECT_EQ(scenario.solver.sleep_speed, 0.1);
  const Scenario settled = parse_scenario(stacks("sleep_after = 0"), "g/a.toml");
  EXPECT_DOUBLE_EQ(*settled.solver.sleep_speed, 0.05) << "of crates of a metre";
  EXPECT_FALSE(parse_scenario(stacks(""), "g/a.toml").solver.sleep_after);
}

TEST(SleepKeys, AnExpectationOfSleepIsJudged) {
  const std::string expect =
      "[[expect]]\na = \"lower\"\nb = \"upper\"\nframes = [40, 50]\nasleep = ";
  for (const bool wanted : {true, false}) {
    const Scenario scenario = parse_scenario(
        stacks("sleep_after = 0.5", expect + (wanted ? "true" : "false")), "g/a.toml");
    Runner runner(scenario);
    const std::vector<std::string> unmet = unmet_expectations(scenario, {runner.frame(45)});
    ASSERT_EQ(unmet.size(), wanted ? 0u : 1u);
    if (!wanted) {
      EXPECT_THAT(unmet[0], HasSubstr("expected no sleep, got sleep"));
    }
  }
  EXPECT_THAT([&] { parse_scenario(stacks("", expect + "true"), "g/a.toml"); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("sleep_after = 0.5")));
}

}  // namespace
}  // namespace contactscope
