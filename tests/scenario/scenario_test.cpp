#include "scenario/scenario.h"

#include <gmock/gmock.h>

#include "core/input_error.h"
#include "reduce/reducer.h"
#include "scenario/broken.h"
#include "support/temporary_folder.h"

namespace contactscope {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::IsEmpty;

TEST(Scenario, TheSmallestFileGetsTheDefaults) {
  const Scenario scenario = parse_scenario(two_boxes(), "some/where/hull/two_boxes.toml");
  EXPECT_EQ(scenario.name, "hull/two_boxes");
  EXPECT_EQ(scenario.path, "some/where/hull/two_boxes.toml");
  EXPECT_EQ(scenario.title, "Two boxes");
  EXPECT_EQ(scenario.source, "");
  EXPECT_THAT(scenario.tags, IsEmpty());
  EXPECT_EQ(scenario.up, "y");
  EXPECT_EQ(scenario.frames, 1);
  EXPECT_EQ(scenario.dt, 1.0 / 60.0);
  EXPECT_EQ(scenario.scalar, Scalar::Float);

  ASSERT_EQ(scenario.shapes.size(), 2u);
  const ScenarioShape& crate = scenario.shapes[0];
  EXPECT_EQ(crate.name, "crate");
  EXPECT_EQ(crate.type, "box");
  EXPECT_EQ(crate.pose.position, Vec3d(0, 0, 0));
  EXPECT_EQ(crate.pose.rotation.coeffs(), Quatd::Identity().coeffs());
  EXPECT_THAT(crate.motion.keyframes, IsEmpty());
  ASSERT_NE(crate.hull(), nullptr);
  EXPECT_EQ(crate.hull()->vertex_count(), 8);

  ASSERT_EQ(scenario.pairs.size(), 1u);
  const ScenarioPair& pair = scenario.pairs[0];
  EXPECT_EQ(pair.a, 0);
  EXPECT_EQ(pair.b, 1);
  EXPECT_EQ(pair.label, "");
  EXPECT_EQ(pair.pipeline.scalar, Scalar::Float);
  EXPECT_EQ(pair.pipeline.reducer, "optimal_deepest");
  EXPECT_EQ(pair.pipeline.max_points, 4);
  EXPECT_EQ(pair.pipeline.margin, 0);
  EXPECT_TRUE(pair.pipeline.cache);
  EXPECT_EQ(pair.pipeline.preference, Preference::Relative);

  ASSERT_EQ(scenario.views.size(), 1u);
  const View& view = scenario.views[0];
  EXPECT_EQ(view.name, "main");
  EXPECT_FALSE(view.eye || view.target || view.fov_degrees || view.orthographic_height);
  EXPECT_EQ(view.focus, Focus::Shapes);
  EXPECT_EQ(view.story, Story::None);
  EXPECT_THAT(view.layers,
              ElementsAre(Layer::Shapes, Layer::ReferenceFace, Layer::IncidentFace,
                          Layer::ClipPolygons, Layer::Contacts, Layer::Reduced, Layer::Normals));
  EXPECT_THAT(view.panels, IsEmpty());
  EXPECT_THAT(scenario.expectations, IsEmpty());
  EXPECT_THAT(scenario.snapshots.frames, ElementsAre(0));
  EXPECT_EQ(scenario.snapshots.width, 640);
  EXPECT_EQ(scenario.snapshots.height, 360);
}

constexpr const char* kEverything = R"(# Every key of the format that scripted hulls have.
title  = "Everything — with a dash"
source = "Gregorius 2015"
tags   = ["hull-hull", "clip"]
up     = "z"

[time]
frames = 24
dt     = 0.041666

[shapes.tower]
type = "cylinder"
radius = 0.5
half_height = 2
segments = 12
position = [0, 3, 0]
[shapes.tower.motion]
keyframes = [ { time = 0.0, position = [0, 3, 0] },
              { time = 0.5, rotation = { axis = [0, 1, 0], degrees = 90 } } ]

[shapes.anvil]
type = "cone"
radius = 1
half_height = 0.25
segments = 3
motion = { velocity = [1, 0, 0], angular_velocity = [0, 2, 0] }

[shapes."a shard"]
type = "hull"
vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
motion = { dynamic = false }

[[pairs]]
a = "tower"
b = "anvil"

[[pairs]]
a = "a shard"
b = "tower"
label = "off"
manifold = "one-shot"
reducer = "none"
max_points = 64
margin = 0
cache = true
preference = "relative"

[[pairs]]
a = "a shard"
b = "tower"
label = "on"

[pipeline]
scalar = "double"
manifold = "one-shot"
reducer = "area"
max_points = 6
margin = 0.02
cache = false
preference = "none"

[world]
gravity = [0, 0, -9.81]
friction = 0.6
[solver]
iterations = 10
position_correction = "soft"
warm_start = true

[[views]]
name = "close-up_1"
eye = [3, 2, 3]
target = [0, 0.5, 0]
fov_degrees = 35
focus = "shapes"
story = "clip_steps"
layers = ["sat_axes", "ids", "coherent", "side_planes", "dropped"]
panels = ["axis_history", "summary", "contact_plane"]
[[views]]
orthographic_height = 2.5
story = "none"
layers = []

[[expect]]
frames = [3, 7]
a = "a shard"
b = "tower"
label = "on"
state = "touching"
points = 4
axis = "edge_edge"
normal = [0, -1, 0]
separation = -0.005
tolerance = 1e-4
[[expect]]
a = "tower"
b = "anvil"
state = "separated"

[snapshots]
frames = [0, 2, 23]
size = [320, 240]
)";

TEST(Scenario, EveryKeyIsRead) {
  const Scenario scenario = parse_scenario(kEverything, "hull/everything.toml");
  EXPECT_EQ(scenario.title, "Everything \u2014 with a dash");
  EXPECT_EQ(scenario.source, "Gregorius 2015");
  EXPECT_THAT(scenario.tags, ElementsAre("hull-hull", "clip"));
  EXPECT_EQ(scenario.up, "z");
  EXPECT_EQ(scenario.frames, 24);
  EXPECT_EQ(scenario.dt, 0.041666);
  EXPECT_EQ(scenario.scalar, Scalar::Double);

  ASSERT_EQ(scenario.shapes.size(), 3u);  // in file order, which is not alphabetical
  EXPECT_EQ(scenario.shapes[0].name, "tower");
  EXPECT_EQ(scenario.shapes[1].name, "anvil");
  EXPECT_EQ(scenario.shapes[2].name, "a shard");
  EXPECT_EQ(scenario.shapes[0].hull()->vertex_count(), 24);
  EXPECT_EQ(scenario.shapes[0].hull()->face_count(), 14);
  EXPECT_EQ(scenario.shapes[1].hull()->vertex_count(), 4);
  EXPECT_EQ(scenario.shapes[2].hull()->face_count(), 4);
  ASSERT_EQ(scenario.shapes[0].motion.keyframes.size(), 2u);
  EXPECT_EQ(scenario.shapes[0].motion.keyframes[1].time, 0.5);
  EXPECT_EQ(scenario.shapes[0].motion.keyframes[1].pose.position, Vec3d(0, 3, 0));
  EXPECT_EQ(scenario.shapes[1].motion.velocity, Vec3d(1, 0, 0));
  EXPECT_EQ(scenario.shapes[1].motion.angular_velocity, Vec3d(0, 2, 0));

  ASSERT_EQ(scenario.pairs.size(), 3u);
  EXPECT_EQ(scenario.pairs[0].a, 0);
  EXPECT_EQ(scenario.pairs[0].b, 1);
  for (const std::size_t inherits : {0u, 2u}) {
    const PipelineSettings& settings = scenario.pairs[inherits].pipeline;
    EXPECT_EQ(settings.scalar, Scalar::Double);
    EXPECT_EQ(settings.reducer, "area");
    EXPECT_EQ(settings.max_points, 6);
    EXPECT_EQ(settings.margin, 0.02);
    EXPECT_FALSE(settings.cache);
    EXPECT_EQ(settings.preference, Preference::None);
  }
  EXPECT_EQ(scenario.pairs[1].a, 2);
  EXPECT_EQ(scenario.pairs[1].b, 0);
  EXPECT_EQ(scenario.pairs[1].label, "off");
  const PipelineSettings& overridden = scenario.pairs[1].pipeline;
  EXPECT_EQ(overridden.scalar, Scalar::Double);
  EXPECT_EQ(overridden.reducer, "none");
  EXPECT_EQ(overridden.max_points, 64);
  EXPECT_EQ(overridden.margin, 0);
  EXPECT_TRUE(overridden.cache);
  EXPECT_EQ(overridden.preference, Preference::Relative);

  ASSERT_EQ(scenario.views.size(), 2u);
  const View& view = scenario.views[0];
  EXPECT_EQ(view.name, "close-up_1");
  EXPECT_EQ(view.eye, Vec3d(3, 2, 3));
  EXPECT_EQ(view.target, Vec3d(0, 0.5, 0));
  EXPECT_EQ(view.fov_degrees, 35);
  EXPECT_EQ(view.focus, Focus::Shapes);
  EXPECT_EQ(view.story, Story::ClipSteps);
  EXPECT_THAT(view.layers, ElementsAre(Layer::SatAxes, Layer::Ids, Layer::Coherent,
                                       Layer::SidePlanes, Layer::Dropped));
  EXPECT_THAT(view.panels, ElementsAre(Panel::AxisHistory, Panel::Summary, Panel::ContactPlane));
  EXPECT_EQ(scenario.views[1].name, "main");
  EXPECT_EQ(scenario.views[1].orthographic_height, 2.5);
  EXPECT_THAT(scenario.views[1].layers, IsEmpty());

  ASSERT_EQ(scenario.expectations.size(), 2u);
  const Expectation& expectation = scenario.expectations[0];
  EXPECT_EQ(expectation.first_frame, 3);
  EXPECT_EQ(expectation.last_frame, 7);
  EXPECT_EQ(expectation.a, 2);
  EXPECT_EQ(expectation.b, 0);
  EXPECT_EQ(expectation.label, "on");
  EXPECT_EQ(expectation.state, "touching");
  EXPECT_EQ(expectation.points, 4);
  EXPECT_EQ(expectation.axis, "edge_edge");
  EXPECT_EQ(expectation.normal, Vec3d(0, -1, 0));
  EXPECT_EQ(expectation.separation, -0.005);
  EXPECT_EQ(expectation.tolerance, 1e-4);
  EXPECT_EQ(expectation.line, 84);
  EXPECT_EQ(scenario.expectations[1].first_frame, 0);
  EXPECT_EQ(scenario.expectations[1].last_frame, 23);
  EXPECT_EQ(scenario.expectations[1].state, "separated");
  EXPECT_EQ(scenario.expectations[1].tolerance, 1e-5);
  EXPECT_FALSE(scenario.expectations[1].points || scenario.expectations[1].normal);

  EXPECT_THAT(scenario.snapshots.frames, ElementsAre(0, 2, 23));
  EXPECT_EQ(scenario.snapshots.width, 320);
  EXPECT_EQ(scenario.snapshots.height, 240);
}

TEST(Scenario, AViewMayBeOfTheContactPlane) {
  const Scenario scenario =
      parse_scenario(two_boxes("[[views]]\nkind = \"contact_plane\"\n[[views]]\nname = \"third\"\n"
                               "choices = 3\nkind = \"contact_plane\"\n[[views]]\n"
                               "name = \"space\"\nkind = \"scene\"\nlayers = [\"ids\"]\n"),
                     "g/a.toml");
  ASSERT_EQ(scenario.views.size(), 3u);
  EXPECT_EQ(scenario.views[0].name, "main");
  EXPECT_EQ(scenario.views[0].kind, ViewKind::ContactPlane);
  EXPECT_EQ(scenario.views[0].choices, 0);
  EXPECT_EQ(scenario.views[1].name, "third");
  EXPECT_EQ(scenario.views[1].kind, ViewKind::ContactPlane);
  EXPECT_EQ(scenario.views[1].choices, 3);
  EXPECT_EQ(scenario.views[2].kind, ViewKind::Scene);
  EXPECT_THAT(scenario.views[2].layers, ElementsAre(Layer::Ids));
  EXPECT_EQ(parse_scenario(two_boxes(), "g/a.toml").views[0].kind, ViewKind::Scene);
  EXPECT_EQ(complaint(two_boxes("[[views]]\nkind = \"contact_plane\"\nchoices = 64")),
            "no complaint");
}

TEST(Scenario, PairsDefaultToEveryPairInFileOrder) {
  const std::string shape = "\ntype = \"box\"\nhalf_extents = [1, 1, 1]\n";
  const Scenario scenario = parse_scenario(
      "title = \"a\"\n[shapes.c]" + shape + "[shapes.a]" + shape + "[shapes.b]" + shape,
      "g/a.toml");
  std::vector<std::string> pairs;
  for (const ScenarioPair& pair : scenario.pairs)
    pairs.push_back(scenario.shapes[static_cast<std::size_t>(pair.a)].name +
                    scenario.shapes[static_cast<std::size_t>(pair.b)].name);
  EXPECT_THAT(pairs, ElementsAre("ca", "cb", "ab"));
}

TEST(Scenario, OneShapeMakesNoPair) {
  const Scenario scenario =
      parse_scenario(one_shape("type = \"box\"\nhalf_extents = [1, 1, 1]"), "g/a.toml");
  EXPECT_THAT(scenario.pairs, IsEmpty());
}

TEST(Scenario, SnapshotsDefaultToFirstMiddleAndLast) {
  const auto frames = [](int count) {
    return parse_scenario(two_boxes("[time]\nframes = " + std::to_string(count)), "g/a.toml")
        .snapshots.frames;
  };
  EXPECT_THAT(frames(1), ElementsAre(0));
  EXPECT_THAT(frames(2), ElementsAre(0, 1));
  EXPECT_THAT(frames(3), ElementsAre(0, 1, 2));
  EXPECT_THAT(frames(24), ElementsAre(0, 11, 23));
}

TEST(Scenario, EveryListedReducerLayerAndPanelIsAccepted) {
  ASSERT_FALSE(reducers().empty());
  for (const ReducerInfo& info : reducers()) {
    const Scenario scenario =
        parse_scenario(two_boxes("[pipeline]\nreducer = \"" + info.name + "\""), "g/a.toml");
    EXPECT_EQ(scenario.pairs[0].pipeline.reducer, info.name);
  }
  const auto naming = [](const std::string& key, std::string_view name) {
    return complaint(two_boxes("[[views]]\n" + key + " = [\"" + std::string(name) + "\"]"));
  };
  for (const std::string_view layer : kLayerNames)
    EXPECT_EQ(naming("layers", layer), "no complaint");
  for (const std::string_view panel : kPanelNames)
    EXPECT_EQ(naming("panels", panel), "no complaint");
}

TEST(Scenario, AScaleOfImpulsesIsOneThatALegendCanState) {
  const auto scale = [](const std::string& value) {
    return two_boxes("[[views]]\nimpulse_scale = " + value);
  };
  EXPECT_EQ(parse_scenario(scale("0.005"), "g/a.toml").views[0].impulse_scale, 0.005);
  EXPECT_EQ(complaint(scale("1000")), "no complaint");
  EXPECT_THAT(complaint(scale("0.03")), ::testing::HasSubstr("1, 2 or 5 times a power of ten"));
}

TEST(Scenario, TheDefaultReducerExists) {
  EXPECT_NE(find_reducer(PipelineSettings().reducer), nullptr);
  EXPECT_NE(find_reducer(PipelineSettings().reducer), nullptr);
}

TEST(Scenario, LimitsThemselvesAreAccepted) {
  EXPECT_EQ(complaint(two_boxes("[time]\nframes = 100000")), "no complaint");
  EXPECT_EQ(complaint(two_boxes("[pipeline]\nmax_points = 1")), "no complaint");
  EXPECT_EQ(complaint(two_boxes("[snapshots]\nsize = [64, 8192]")), "no complaint");
  EXPECT_EQ(complaint(one_shape("type = \"box\"\nhalf_extents = [1e-9, 1, 1e9]")), "no complaint");
  EXPECT_EQ(complaint(one_shape("type = \"cylinder\"\nradius = 1\nhalf_height = 1\nsegments = 64")),
            "no complaint");
}

TEST(Scenario, AByteOrderMarkAndWindowsLinesAreAccepted) {
  std::string text = "\xEF\xBB\xBF";
  for (const char c : two_boxes()) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(complaint(text), "no complaint");
}

// Dots join names in keys only; numbers, strings and comments may have any number of them.
TEST(Scenario, DotsInNumbersStringsAndCommentsAreNoKeys) {
  std::string dots;
  for (int i = 0; i < 50; ++i) dots += "a.";
  EXPECT_EQ(complaint("title = \"" + dots + " \\\" " + dots + "\" # " + dots + "\n" +
                      two_boxes("position = [0.1, 0.2, 0.3] # it's " + dots +
                                "\n[[views]]\neye = "
                                "[1.5,\n2.5, 3.5]\n# " +
                                dots)
                          .substr(20)),
            "no complaint");
  EXPECT_EQ(complaint("title = '" + dots + "'\nsource = \"\"\"" + dots + "\n\"" + dots +
                      "\"\"\"\n" + two_boxes().substr(20)),
            "no complaint");
}

TEST(Scenario, IsNamedAfterItsFolderAndFile) {
  const auto name = [](const char* path) { return parse_scenario(two_boxes(), path).name; };
  EXPECT_EQ(name("/data/scenarios/hull/a.toml"), "hull/a");
  EXPECT_EQ(name("./hull/../hull/a.b.toml"), "hull/a.b");
  EXPECT_EQ(name("/a.toml"), "a");
  EXPECT_THAT(name("a.toml"), EndsWith("/a"));
}

TEST(Scenario, ObjFilesAreFoundNextToTheScenario) {
  const TemporaryFolder folder;
  folder.write("hull/parts/wedge.obj",
               "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 1\nv 2 0 1\nv 0 1 1\n"
               "f 1 3 2\nf 4 5 6\nf 1 2 5 4\nf 2 3 6 5\nf 3 1 4 6\n");
  const std::string path =
      folder.write("hull/from_file.toml", one_shape("type = \"hull\"\nfile = \"parts/wedge.obj\""));
  const Scenario scenario = load_scenario(path);
  EXPECT_EQ(scenario.name, "hull/from_file");
  ASSERT_EQ(scenario.shapes.size(), 1u);
  EXPECT_EQ(scenario.shapes[0].hull()->vertex_count(), 6);
  EXPECT_EQ(scenario.shapes[0].hull()->face_count(), 5);
}

}  // namespace
}  // namespace contactscope
