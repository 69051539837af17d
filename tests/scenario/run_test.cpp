#include "scenario/run.h"

#include <thread>

#include <gmock/gmock.h>

#include "manifold/collide_pairs.h"
#include "reduce/reducer.h"
#include "scenario/broken.h"
#include "trace/json.h"

namespace contactscope {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A crate that sinks 5 mm into the floor and turns, then rises off it.
constexpr const char* kSinking = R"(title = "Sinking crate"
source = "by hand"
up = "y"
[time]
frames = 5
dt = 0.25
[shapes.crate]
type = "box"
half_extents = [0.5, 0.5, 0.5]
motion = { keyframes = [ { time = 0.0, position = [0.1, 1.0, 0.2] },
                         { time = 0.5, position = [0.1, 0.995, 0.2] },
                         { time = 1.0, position = [0.1, 1.3, 0.2] } ] }
[shapes.floor]
type = "box"
half_extents = [2, 0.5, 2]
SCALAR
[[expect]]
a = "crate"
b = "floor"
frames = [2, 2]
state = "touching"
points = 4
axis = "face_a"
normal = [0, -1, 0]
separation = -0.005
tolerance = 1e-6
[[expect]]
a = "crate"
b = "floor"
frames = [4, 4]
state = "separated"
points = 0
normal = [0, -1, 0]
separation = 0.3
tolerance = 1e-6
)";

Scenario sinking(const std::string& scalar) {
  std::string text = kSinking;
  text.replace(text.find("SCALAR"), 6, "[pipeline]\nscalar = \"" + scalar + "\"");
  return parse_scenario(text, "hull/sinking.toml");
}

class Run : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scalars, Run, ::testing::Values("float", "double"),
                         [](const ::testing::TestParamInfo<const char*>& test) {
                           return std::string(test.param);
                         });

TEST_P(Run, ASinkingCrateMatchesTheArithmetic) {
  const Scenario scenario = sinking(GetParam());
  Runner runner(scenario);
  for (int frame = 0; frame < scenario.frames; ++frame)
    EXPECT_THAT(unmet_expectations(scenario, {runner.frame(frame)}), IsEmpty());
}

TEST_P(Run, TheHeaderDescribesTheScenario) {
  const Scenario scenario = sinking(GetParam());
  const trace::Header header = Runner(scenario).header();
  EXPECT_EQ(header.scenario, "hull/sinking");
  EXPECT_EQ(header.title, "Sinking crate");
  EXPECT_EQ(header.source, "by hand");
  EXPECT_EQ(header.scalar, GetParam());
  EXPECT_EQ(header.up, "y");
  EXPECT_EQ(header.frames, 5);
  ASSERT_EQ(header.shapes.size(), 2u);
  const trace::Shape& crate = header.shapes[0];
  EXPECT_EQ(crate.name, "crate");
  EXPECT_EQ(crate.type, "box");
  EXPECT_EQ(crate.vertices.size(), 8u);
  EXPECT_EQ(crate.faces.size(), 6u);
  EXPECT_EQ(crate.edges.size(), 12u);
  EXPECT_EQ(crate.center_of_mass, Vec3d(0, 0, 0));
  for (const std::array<int, 2>& edge : crate.edges) {
    const Vec3d along = crate.vertices[static_cast<std::size_t>(edge[0])] -
                        crate.vertices[static_cast<std::size_t>(edge[1])];
    EXPECT_EQ(along.norm(), 1);  // a box's edges, not its diagonals
  }
  for (const std::vector<int>& face : crate.faces) {
    ASSERT_EQ(face.size(), 4u);
    const Vec3d& p = crate.vertices[static_cast<std::size_t>(face[0])];
    const Vec3d& q = crate.vertices[static_cast<std::size_t>(face[1])];
    const Vec3d& r = crate.vertices[static_cast<std::size_t>(face[2])];
    EXPECT_GT((q - p).cross(r - q).dot(p), 0);  // counter-clockwise from outside
  }
}

TEST_P(Run, FramesCarryTheirTimeAndPoses) {
  const Scenario scenario = sinking(GetParam());
  const trace::Frame frame = Runner(scenario).frame(3);
  EXPECT_EQ(frame.frame, 3);
  EXPECT_EQ(frame.time, 0.75);
  ASSERT_EQ(frame.poses.size(), 2u);
  EXPECT_EQ(frame.poses[0].first, "crate");
  EXPECT_EQ(frame.poses[1].first, "floor");
  const Vec3d off = frame.poses[0].second.position - Vec3d(0.1, 1.1475, 0.2);
  EXPECT_NEAR(off.norm(), 0, 1e-7);
  ASSERT_EQ(frame.pairs.size(), 1u);
  EXPECT_EQ(frame.pairs[0].a, "crate");
  EXPECT_EQ(frame.pairs[0].b, "floor");
  EXPECT_EQ(frame.pairs[0].kind, "hull-hull");
}

// The poses in the trace are bitwise the ones of the pipeline.
TEST(RunScalar, FloatPosesAndVerticesAreThoseOfFloat) {
  const std::string text = one_shape(
      "type = \"box\"\nhalf_extents = [0.1, 0.3, 0.7]\nposition = [0.1, 0.2, 0.3]\n"
      "rotation = { axis = [1, 2, 3], degrees = 40 }\n");
  const Scenario in_float = parse_scenario(text, "g/a.toml");
  const Scenario in_double = parse_scenario(text + "[pipeline]\nscalar = \"double\"", "g/a.toml");
  const Pose<double> rounded = Runner(in_float).frame(0).poses.at(0).second;
  const Pose<double> exact = Runner(in_double).frame(0).poses.at(0).second;
  EXPECT_EQ(exact.position, Vec3d(0.1, 0.2, 0.3));
  EXPECT_EQ(rounded.position, Vec3d(double(0.1f), double(0.2f), double(0.3f)));
  EXPECT_EQ(rounded.rotation.w(), double(static_cast<float>(exact.rotation.w())));
  EXPECT_NE(rounded.rotation.w(), exact.rotation.w());
  EXPECT_EQ(Runner(in_float).header().shapes[0].vertices[7].cwiseAbs(),
            Vec3d(double(0.1f), double(0.3f), double(0.7f)));
  EXPECT_EQ(Runner(in_double).header().shapes[0].vertices[7].cwiseAbs(), Vec3d(0.1, 0.3, 0.7));
}

TEST_P(Run, RecordingChangesNothing) {
  const Scenario scenario = sinking(GetParam());
  Runner watched(scenario), unwatched(scenario);
  for (int number = 0; number < scenario.frames; ++number) {
    trace::Frame recorded = watched.frame(number);
    const trace::Frame unrecorded = unwatched.frame_unrecorded(number);
    ASSERT_EQ(unrecorded.pairs.size(), 1u);
    EXPECT_FALSE(unrecorded.pairs[0].sat || unrecorded.pairs[0].clip ||
                 unrecorded.pairs[0].reduction);
    const bool hit = recorded.pairs[0].cache && recorded.pairs[0].cache->hit;
    EXPECT_NE(recorded.pairs[0].sat.has_value(), hit);
    EXPECT_FALSE(unrecorded.pairs[0].cache);
    recorded.pairs[0].cache.reset();
    recorded.pairs[0].sat.reset();
    recorded.pairs[0].clip.reset();
    recorded.pairs[0].reduction.reset();
    if (recorded.pairs[0].state == "separated") recorded.pairs[0].separation = 0;
    EXPECT_EQ(trace::to_json_line(unrecorded), trace::to_json_line(recorded));
  }
}

TEST_P(Run, RunnersOfOneScenarioDoNotDisturbEachOtherOnThreads) {
  const Scenario scenario = sinking(GetParam());
  std::vector<std::string> alone;
  for (int frame = 0; frame < scenario.frames; ++frame)
    alone.push_back(trace::to_json_line(Runner(scenario).frame(frame)));
  std::vector<std::string> together(alone.size());
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < together.size(); ++i)
      threads.emplace_back([&, i] {
        together[i] = trace::to_json_line(Runner(scenario).frame(static_cast<int>(i)));
      });
  }
  EXPECT_EQ(together, alone);
  EXPECT_NE(alone[0], alone[2]);
}

// A turning crate, once for each reducer: those that use the previous frame have a choice to keep.
TEST_P(Run, AFrameDoesNotDependOnEarlierRequests) {
  std::string text =
      two_boxes("position = [0, -0.99, 0]\n[time]\nframes = 8\ndt = 0.1\n[pipeline]\nscalar = \"" +
                std::string(GetParam()) + "\"\n");
  text.replace(text.find("[2, 0.5, 2]"), 11, "[0.5, 0.5, 0.5]");
  text.replace(text.find("half_extents"), 0,
               "rotation = { axis = [0, 1, 0], degrees = 35 }\n"
               "motion = { angular_velocity = [0.002, 0.3, 0.001] }\n");
  for (const ReducerInfo& info : reducers())
    text += "[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = \"" + info.name + "\"\nreducer = \"" +
            info.name + "\"\n";
  const Scenario scenario = parse_scenario(text, "g/a.toml");
  std::vector<std::string> lines;
  Runner runner(scenario);
  for (int frame = 0; frame < 8; ++frame) lines.push_back(trace::to_json_line(runner.frame(frame)));
  Runner skipping(scenario);
  for (const int frame : {1, 3, 4, 7})
    EXPECT_EQ(trace::to_json_line(skipping.frame(frame)), lines[static_cast<std::size_t>(frame)]);
  for (int frame = 0; frame < 8; ++frame)
    EXPECT_EQ(trace::to_json_line(Runner(scenario).frame(frame)),
              lines[static_cast<std::size_t>(frame)]);
  EXPECT_EQ(Runner(scenario).frame(5).pairs.front().reduction->points.size(), 8u);
}

TEST_P(Run, ACachePersistsAcrossFramesUnlessDisabled) {
  const std::string motion = two_boxes(
      "position = [0, -0.99, 0]\n[time]\nframes = 8\ndt = 0.1\n"
      "[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = \"kept\"\n"
      "[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = \"anew\"\ncache = false\n"
      "[pipeline]\nscalar = \"" +
      std::string(GetParam()) + "\"\n");
  const Scenario scenario = parse_scenario(motion, "g/a.toml");
  Runner runner(scenario);
  for (int number = 0; number < 8; ++number) {
    const trace::Frame frame = runner.frame(number);
    const trace::Pair& kept = frame.pairs[0];
    const trace::Pair& again = frame.pairs[1];
    EXPECT_EQ(kept.cache.has_value(), number > 0);  // nothing to try in the first frame
    if (kept.cache) {
      EXPECT_TRUE(kept.cache->hit);
      EXPECT_EQ(kept.cache->kind, "features");
    }
    EXPECT_EQ(kept.sat.has_value(), number == 0);
    EXPECT_TRUE(kept.clip && again.sat && again.clip);
    EXPECT_FALSE(again.cache);
    ASSERT_EQ(kept.manifolds.size(), 1u);
    EXPECT_EQ(kept.manifolds[0].normal, again.manifolds[0].normal);
    EXPECT_EQ(kept.separation, again.separation);
  }
}

// The oracle is the pipeline itself, run from the first frame with its selection passed on.
TEST(RunMemory, AReducerThatRemembersIsGivenWhatItKeptInTheFrameBefore) {
  int remembering = 0;
  for (const ReducerInfo& info : reducers()) {
    if (!info.remembers) continue;
    ++remembering;
    const Scenario scenario = parse_scenario(
        "title = \"Turning\"\n[time]\nframes = 40\ndt = 0.1\n[pipeline]\nscalar = \"double\"\n"
        "reducer = \"" +
            info.name +
            "\"\n[shapes.floor]\ntype = \"box\"\nhalf_extents = [0.5, 0.5, 0.5]\n"
            "[shapes.crate]\ntype = \"box\"\nhalf_extents = [0.5, 0.5, 0.5]\n"
            "position = [0, 0.99, 0]\nrotation = { axis = [0, 1, 0], degrees = 30 }\n"
            "motion = { angular_velocity = [0, 0.1, 0] }\n",
        "g/a.toml");
    Runner runner(scenario);
    const auto ids_of = [](const Manifold<double>& manifold) {
      std::vector<FeatureId> ids;
      for (const ContactPoint<double>& point : manifold.points) ids.push_back(point.id);
      return ids;
    };
    std::vector<FeatureId> before;
    int swayed = 0;  // frames in which the memory decides
    for (int frame = 0; frame < scenario.frames; ++frame) {
      CollideOptions options;
      options.reducer = find_reducer(info.name);
      const auto manifold = [&](const std::vector<FeatureId>& previous) {
        options.reduction.previous = previous;
        const double time = frame * scenario.dt;
        return collide_hull_hull(*scenario.shapes[0].hull(), pose_at(scenario.shapes[0], time),
                                 *scenario.shapes[1].hull(), pose_at(scenario.shapes[1], time),
                                 options);
      };
      const std::vector<FeatureId> expected = ids_of(manifold(before));
      if (expected != ids_of(manifold({}))) ++swayed;
      before = expected;
      std::vector<std::string> spelled, found;
      for (const FeatureId& id : expected) spelled.push_back(to_string(id));
      const trace::Frame recorded = runner.frame(frame);
      for (const trace::Point& point : recorded.pairs.at(0).manifolds.at(0).points)
        found.push_back(point.id);
      ASSERT_EQ(found, spelled) << info.name << ", frame " << frame;
    }
    EXPECT_GT(swayed, 0) << info.name << " has no use for its memory here";
  }
  EXPECT_GT(remembering, 0);
}

/// Every kept point, frame by frame, without ids: those are mirrored.
std::vector<std::vector<Vec3d>> kept_of(const Scenario& scenario, std::size_t pair) {
  Runner runner(scenario);
  std::vector<std::vector<Vec3d>> kept;
  for (int frame = 0; frame < scenario.frames; ++frame) {
    std::vector<Vec3d>& points = kept.emplace_back();
    const trace::Frame found = runner.frame(frame);
    for (const trace::Manifold& manifold : found.pairs.at(pair).manifolds)
      for (const trace::Point& point : manifold.points) points.push_back(point.position);
  }
  return kept;
}

/// A slab that sways on something, through an angle at which two choices are equally good.
std::string swaying_on(const std::string& floor, bool slab_first) {
  const std::string slab =
      "[shapes.slab]\ntype = \"box\"\nhalf_extents = [0.5, 0.25, 0.5]\n"
      "position = [0, 0.245, 0]\n[shapes.slab.motion]\nkeyframes = [";
  std::string keyframes;
  for (int i = 0; i < 5; ++i)
    keyframes +=
        "{ time = " + std::to_string(i) +
        ", rotation = { axis = [0.001, 1, 0.0015], degrees = " + (i % 2 == 0 ? "42.5" : "47.5") +
        " } },";
  const std::string moving = slab + keyframes + "]\n";
  return "title = \"t\"\n[time]\nframes = 41\ndt = 0.1\n" +
         (slab_first ? moving + floor : floor + moving) +
         "[[pairs]]\na = \"floor\"\nb = \"slab\"\nreducer = \"coherent\"\n"
         "[[pairs]]\na = \"slab\"\nb = \"floor\"\nreducer = \"coherent\"\nlabel = \"traded\"\n"
         "[[pairs]]\na = \"slab\"\nb = \"floor\"\nreducer = \"optimal\"\nlabel = \"best\"\n";
}

const std::string kBoxFloor =
    "[shapes.floor]\ntype = \"box\"\nhalf_extents = [0.5, 0.5, 0.5]\nposition = [0, -0.5, 0]\n";
TEST(RunReducers, StatefulOnesKeepTheSameWhicheverShapeIsNamedFirst) {
  for (const bool slab_first : {false, true}) {
    const Scenario scenario = parse_scenario(swaying_on(kBoxFloor, slab_first), "g/a.toml");
    const auto kept = kept_of(scenario, 0);
    EXPECT_EQ(kept, kept_of(scenario, 1)) << "slab first: " << slab_first;
    EXPECT_NE(kept, kept_of(scenario, 2)) << "nothing to remember here";
  }
}

TEST(RunPairs, EachEntryRunsWithItsOwnSettings) {
  const std::string crate_on_floor = "[[pairs]]\na = \"crate\"\nb = \"floor\"\n";
  const Scenario scenario = parse_scenario(
      two_boxes("position = [0, -0.995, 0]\nrotation = { axis = [0, 1, 0], degrees = 45 }\n" +
                crate_on_floor + "label = \"all\"\nreducer = \"none\"\n" + crate_on_floor +
                "label = \"three\"\nmax_points = 3\n" + crate_on_floor +
                "label = \"turned\"\npreference = \"none\"\n"),
      "g/a.toml");
  const trace::Frame frame = Runner(scenario).frame(0);
  ASSERT_EQ(frame.pairs.size(), 3u);
  EXPECT_EQ(frame.pairs[0].label, "all");
  EXPECT_FALSE(frame.pairs[0].reduction);
  EXPECT_EQ(frame.pairs[1].label, "three");
  ASSERT_TRUE(frame.pairs[1].reduction);
  EXPECT_EQ(frame.pairs[1].reduction->method, "optimal_deepest");
  EXPECT_EQ(frame.pairs[1].manifolds.at(0).points.size(), 3u);
  EXPECT_EQ(frame.pairs[1].sat->preference, "relative");
  EXPECT_EQ(frame.pairs[2].sat->preference, "none");
}

TEST(RunPairs, TheMarginKeepsSeparatedPoints) {
  const std::string gap = "position = [0, -1.01, 0]\n[pipeline]\nmargin = ";
  const Scenario none = parse_scenario(two_boxes(gap + "0"), "g/a.toml");
  const Scenario some = parse_scenario(two_boxes(gap + "0.02"), "g/a.toml");
  const trace::Frame without = Runner(none).frame(0);
  const trace::Frame with = Runner(some).frame(0);
  EXPECT_EQ(without.pairs.at(0).state, "separated");
  EXPECT_THAT(without.pairs.at(0).manifolds, IsEmpty());
  EXPECT_EQ(with.pairs.at(0).state, "touching");
  EXPECT_EQ(with.pairs.at(0).manifolds.at(0).points.size(), 4u);
  EXPECT_NEAR(with.pairs.at(0).separation, 0.01, 1e-6);
}

TEST(RunPairs, ASceneOfOneShapeHasAPoseAndNoPairs) {
  const Scenario scenario =
      parse_scenario(one_shape("type = \"box\"\nhalf_extents = [1, 1, 1]"), "g/a.toml");
  const trace::Frame frame = Runner(scenario).frame(0);
  EXPECT_EQ(frame.poses.size(), 1u);
  EXPECT_THAT(frame.pairs, IsEmpty());
}

TEST(RunPairs, ThePenetrationMethodOfPipelineOrPairIsUsedAndRecorded) {
  const std::string deep =
      "position = [0, -0.95, 0]\nrotation = { axis = [0, 1, 0], degrees = 20 }\n"
      "[pipeline]\npenetration = \"epa\"\n";
  const std::string pairs =
      "[[pairs]]\na = \"crate\"\nb = \"floor\"\n[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = "
      "\"by sampling\"\n"
      "penetration = \"sampling\"\n[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = \"by sat\"\n"
      "penetration = \"sat\"\n";
  Scenario scenario = parse_scenario(two_boxes(deep + pairs), "g/a.toml");
  const trace::Frame frame = Runner(scenario).frame(0);
  ASSERT_EQ(frame.pairs.size(), 3u);
  ASSERT_TRUE(frame.pairs[0].penetration);
  EXPECT_EQ(frame.pairs[0].penetration->method, "epa");
  EXPECT_EQ(frame.pairs[0].penetration->status, "converged");
  EXPECT_NEAR(frame.pairs[0].penetration->depth, 0.05, 1e-6);
  EXPECT_EQ(frame.pairs[0].penetration->fallback, "");
  EXPECT_FALSE(frame.pairs[0].sat);
  EXPECT_EQ(frame.pairs[1].penetration->method, "sampling");
  EXPECT_FALSE(frame.pairs[2].penetration);
  EXPECT_TRUE(frame.pairs[2].sat);
  for (const trace::Pair& pair : frame.pairs) {
    EXPECT_NEAR(pair.separation, -0.05, 1e-6) << pair.label;
    EXPECT_FALSE(pair.minkowski);
    EXPECT_EQ(pair.manifolds.at(0).points.size(), 4u);
  }

  scenario.views.at(0).panels = {Panel::Minkowski, Panel::GaussMap};
  const trace::Frame shown = Runner(scenario).frame(0);
  EXPECT_TRUE(shown.pairs[0].minkowski);
  EXPECT_FALSE(shown.pairs[2].sat->edge_pairs.empty());
}

TEST(RunPairs, APenetrationMethodThatIsNoneIsRefused) {
  const std::string text = two_boxes("position = [0, 0, 0]\n[pipeline]\npenetration = \"gjk\"\n");
  EXPECT_THROW(parse_scenario(text, "g/a.toml"), InputError);
}

}  // namespace
}  // namespace contactscope
