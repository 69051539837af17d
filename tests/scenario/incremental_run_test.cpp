#include <gmock/gmock.h>

#include <map>
#include <set>

#include "scenario/run.h"
#include "trace/json.h"

namespace contactscope {
namespace {

/// A level crate that sinks by 2 mm a frame from 1 mm above the floor, with both kinds of manifold.
constexpr const char* kIncrementalCrate = R"(title = "Sinking crate"
[time]
frames = 8
dt = 0.1
[shapes.crate]
type = "box"
half_extents = [0.5, 0.5, 0.5]
position = [0.0, 1.001, 0.0]
motion = { velocity = [0.0, -0.02, 0.0] }
[shapes.floor]
type = "box"
half_extents = [2, 0.5, 2]
[[pairs]]
a = "crate"
b = "floor"
label = "incremental"
manifold = "incremental"
core_margin = 0.03
breaking_distance = 0.04
confirm = "ids"
[[pairs]]
a = "crate"
b = "floor"
label = "one-shot"
)";

TEST(IncrementalRun, KeysOfAPairAreItsOwn) {
  const Scenario scenario = parse_scenario(kIncrementalCrate, "g/a.toml");
  const PipelineSettings& incremental = scenario.pairs.at(0).pipeline;
  EXPECT_EQ(incremental.manifold, ManifoldKind::Incremental);
  EXPECT_EQ(incremental.incremental, (IncrementalSettings{Confirm::Ids, 0.03, 0.04}));
  EXPECT_EQ(scenario.pairs.at(1).pipeline, PipelineSettings());
}

TEST(IncrementalRun, FourPointsAndAStableManifoldTakeFourFramesNotOne) {
  const Scenario scenario = parse_scenario(kIncrementalCrate, "g/a.toml");
  Runner runner(scenario);
  const char* const verdicts[] = {
      "no contact", "turns about a point", "turns about a line", "turns about a line", "stable",
      "stable"};
  for (int frame = 0; frame < 6; ++frame) {
    const trace::Frame facts = runner.frame(frame);
    const trace::Pair& incremental = facts.pairs.at(0);
    ASSERT_TRUE(incremental.incremental && incremental.stability) << frame;
    EXPECT_EQ(incremental.incremental->points.size(), static_cast<std::size_t>(std::min(frame, 4)));
    EXPECT_EQ(incremental.incremental->margin_b, static_cast<double>(0.03F));
    EXPECT_EQ(incremental.stability->verdict, verdicts[frame]) << frame;
    EXPECT_EQ(incremental.stability->shape, "crate");
    // No view shows it, and no key requests the other kind.
    EXPECT_FALSE(facts.pairs.at(1).stability || facts.pairs[1].incremental);
    ASSERT_EQ(facts.pairs[1].manifolds.size(), frame == 0 ? 0U : 1U);
    for (const trace::Manifold& manifold : facts.pairs[1].manifolds)
      EXPECT_EQ(manifold.points.size(), 4U);
  }
}

TEST(IncrementalRun, AViewThatShowsStabilityHasItOfEveryPair) {
  const Scenario scenario = parse_scenario(
      std::string(kIncrementalCrate) + "[[views]]\npanels = [\"stability\"]\n", "g/a.toml");
  const trace::Frame facts = Runner(scenario).frame(1);
  ASSERT_TRUE(facts.pairs.at(1).stability);
  EXPECT_EQ(facts.pairs[1].stability->verdict, "stable");
  EXPECT_NEAR(facts.pairs[1].stability->margin, 0.5, 1e-6);
}

TEST(IncrementalRun, AFrameDoesNotDependOnEarlierRequests) {
  const Scenario scenario = parse_scenario(kIncrementalCrate, "g/a.toml");
  Runner in_order(scenario);
  std::vector<std::string> lines;
  for (int frame = 0; frame < 8; ++frame)
    lines.push_back(trace::to_json_line(in_order.frame(frame)));
  Runner other(scenario);
  for (const int frame : {1, 2, 5, 7})
    EXPECT_EQ(trace::to_json_line(other.frame(frame)), lines[static_cast<std::size_t>(frame)]);
}

TEST(IncrementalRun, ARecordChangesNothingAndSwappingMirrors) {
  const Scenario scenario = parse_scenario(kIncrementalCrate, "g/a.toml");
  std::string text = kIncrementalCrate;
  text.replace(text.find("a = \"crate\"\nb = \"floor\""), 23, "a = \"floor\"\nb = \"crate\"");
  const Scenario swapped = parse_scenario(text, "g/a.toml");
  for (int frame = 1; frame < 8; ++frame) {
    const trace::Manifold recorded = Runner(scenario).frame(frame).pairs.at(0).manifolds.at(0);
    const trace::Manifold bare =
        Runner(scenario).frame_unrecorded(frame).pairs.at(0).manifolds.at(0);
    const trace::Manifold other = Runner(swapped).frame(frame).pairs.at(0).manifolds.at(0);
    EXPECT_EQ(recorded.normal, bare.normal);
    EXPECT_EQ(recorded.normal, Vec3d(-other.normal));
    ASSERT_EQ(recorded.points.size(), bare.points.size());
    ASSERT_EQ(recorded.points.size(), other.points.size());
    for (std::size_t i = 0; i < bare.points.size(); ++i) {
      EXPECT_EQ(recorded.points[i].position, bare.points[i].position);
      EXPECT_EQ(recorded.points[i].id, bare.points[i].id);
      EXPECT_EQ(recorded.points[i].position, other.points[i].position);
      EXPECT_EQ(recorded.points[i].separation, other.points[i].separation);
    }
  }
}

/// A wheel of 64 flat sides that the solver rolls: corners take the places of the previous side's.
constexpr const char* kRollingWheel = R"(title = "Rolling wheel"
[time]
frames = 60
[shapes.floor]
type = "box"
half_extents = [2, 0.1, 0.5]
position = [0, -0.1, 0]
[shapes.wheel]
type = "cylinder"
radius = 0.2
half_height = 0.12
segments = 64
position = [-0.5, 0.199, 0]
rotation = { axis = [1, 0, 0], degrees = 90 }
motion = { dynamic = true, mass = 5, velocity = [0.6, 0, 0], angular_velocity = [0, 0, -3] }
[pipeline]
manifold = "incremental"
breaking_distance = 0.025
[solver]
slop = 0.001
speculative_margin = 0.004
)";

// A wheel of twelve sides rolls: its corners are 31 mm from each other, nearer than the breaking distance.
constexpr const char* kTwoWheels = R"(
title = "two wheels"
[time]
frames = 41
[shapes.floor_1]
type = "box"
half_extents = [0.8, 0.1, 0.05]
position = [0, -0.1, 0]
[shapes.wheel_1]
type = "cylinder"
radius = 0.06
half_height = 0.001
segments = 12
position = [-0.2, 0.0579, 0]
rotation = { axis = [1, 0, 0], degrees = 90 }
motion = { velocity = [0.6, 0, 0], angular_velocity = [0, 0, -10] }
[shapes.floor_2]
type = "box"
half_extents = [0.8, 0.1, 0.05]
position = [0, -0.1, 3]
[shapes.wheel_2]
type = "cylinder"
radius = 0.06
half_height = 0.001
segments = 12
position = [-0.2, 0.0579, 3]
rotation = { axis = [1, 0, 0], degrees = 90 }
motion = { velocity = [0.6, 0, 0], angular_velocity = [0, 0, -10] }
[pipeline]
manifold = "incremental"
core_margin = 0.004
breaking_distance = 0.04
[[pairs]]
a = "floor_1"
b = "wheel_1"
[[pairs]]
a = "floor_2"
b = "wheel_2"
too_close = "reject"
)";

TEST(IncrementalRun, ARejectedPointLeavesTheOldOneUntilThatIsTooFarOff) {
  const Scenario scenario = parse_scenario(kTwoWheels, "g/a.toml");
  Runner runner(scenario);
  int replaced = 0, rejected = 0, lost = 0;
  std::string name;  // of the first point of the pair that rejects
  for (int frame = 0; frame < scenario.frames; ++frame) {
    const trace::Frame facts = runner.frame(frame);
    for (const trace::PersistentPoint& point : facts.pairs.at(0).incremental->points)
      replaced += point.reason == "replaced";
    const trace::Pair& pair = facts.pairs.at(1);
    EXPECT_FALSE(facts.pairs.at(0).incremental->rejects_within);
    EXPECT_EQ(pair.incremental->rejects_within, 0.04);
    ASSERT_LE(pair.manifolds.size(), 1u);
    for (const trace::PersistentPoint& point : pair.incremental->points) {
      if (point.reason == "apart" || point.reason == "slid") ++lost;
      if (point.reason != "too close") continue;
      ++rejected;
      EXPECT_EQ(point.age, 0);
      // It is not in the manifold, and one that is there is within 40 mm.
      double nearest = 1;
      for (const trace::Point& kept : pair.manifolds.at(0).points) {
        EXPECT_NE(kept.id, point.point.id);
        nearest = std::min(nearest, (kept.position - point.point.position).norm());
      }
      EXPECT_LT(nearest, 0.04) << frame;
    }
  }
  EXPECT_GT(replaced, 5);
  EXPECT_GT(rejected, 5);
  EXPECT_GT(lost, 0);
}

TEST(IncrementalRun, AReplacedPointBeginsWithTheImpulseThatItsNameHad) {
  const Scenario scenario = parse_scenario(kRollingWheel, "g/a.toml");
  Runner runner(scenario);
  std::map<std::string, double> before;  // newton seconds, by id
  int replaced = 0, kept = 0;
  for (int frame = 0; frame < 60; ++frame) {
    const trace::Frame facts = runner.frame(frame);
    const trace::Pair& pair = facts.pairs.at(0);
    std::set<std::string> moved;
    for (const trace::PersistentPoint& point : pair.incremental->points)
      if (point.reason == "replaced") moved.insert(point.point.id);
    std::map<std::string, double> now;
    for (const trace::Manifold& manifold : pair.manifolds) {
      for (const trace::Point& point : manifold.points) {
        ASSERT_TRUE(point.impulse) << frame;
        now[point.id] = point.impulse->normal;
        const auto old = before.find(point.id);
        EXPECT_EQ(point.impulse->warm_start, old == before.end() ? 0 : old->second)
            << frame << ": " << point.id;
        if (old == before.end() || old->second == 0) continue;
        ++kept;
        if (moved.contains(point.id)) ++replaced;
      }
    }
    before = now;
  }
  EXPECT_GT(replaced, 10);
  EXPECT_GT(kept, replaced);
}

}  // namespace
}  // namespace contactscope
