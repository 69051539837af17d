#include "scenario/scenario.h"

#include <cmath>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>

#include "scenario/broken.h"
#include "scenario/run.h"
#include "support/temporary_folder.h"

namespace contactscope {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// A grid that deforms, and a ball that rests on it. The value of `deform` begins on line 5.
std::string scene(const std::string& deform, const std::string& rest = "") {
  return R"(title = "A grid"
[shapes.grid]
type = "mesh"
grid = { size = 2, cells = 8 }
motion.deform = )" +
         deform + "\n" + rest + R"(
[shapes.ball]
type = "sphere"
radius = 0.25
position = [0, 0.2, 0]
)";
}

const char* const kWave =
    "{ wave = { axis = [2, 0, 0], direction = [0, 3, 0], amplitude = 0.1, wavelength = 0.8, "
    "speed = 0.4 } }";

std::vector<Vec3d> vertices_in(const trace::Frame& frame) { return frame.deformed.at(0).vertices; }

std::vector<Vec3d> at_rest(const Scenario& scenario) {
  return std::get<Mesh<double>>(*scenario.shape(0).geometry).vertices;
}

/// The largest coordinate of a is 1: two roundings may differ by this much.
constexpr double kFloat = 0x1p-22;

TEST(Deform, AWaveTravels) {
  const Scenario scenario =
      parse_scenario(scene(kWave, "[time]\nframes = 9\ndt = 0.125\n"), "group/idea.toml");
  const std::vector<Vec3d> before = at_rest(scenario);
  Runner runner(scenario);
  for (const int frame : {0, 3, 8}) {
    const std::vector<Vec3d> now = vertices_in(runner.frame(frame));
    ASSERT_EQ(now.size(), before.size());
    for (int i = 0; i < count_of(now); ++i) {
      const Vec3d& x = at(before, i);
      const double height =
          0.1 * std::sin(2 * std::numbers::pi * (x.x() - 0.4 * 0.125 * frame) / 0.8);
      EXPECT_LT((at(now, i) - Vec3d(x.x(), x.y() + height, x.z())).norm(), kFloat);
    }
  }
}

TEST(Deform, ATwistTurnsByHeight) {
  const Scenario scenario = parse_scenario(
      scene("{ twist = { axis = [0, 0, -1], degrees = 90 } }", "[time]\nframes = 5\ndt = 0.25\n"),
      "group/idea.toml");
  const std::vector<Vec3d> before = at_rest(scenario);
  Runner runner(scenario);
  EXPECT_EQ(vertices_in(runner.frame(0)), before);
  const std::vector<Vec3d> now = vertices_in(runner.frame(4));
  for (int i = 0; i < count_of(now); ++i) {
    const Vec3d& x = at(before, i);
    // About -z by -z quarters is about z by z quarters.
    const double angle = std::numbers::pi / 2 * x.z();
    const Vec3d turned(std::cos(angle) * x.x() - std::sin(angle) * x.y(),
                       std::sin(angle) * x.x() + std::cos(angle) * x.y(), x.z());
    EXPECT_LT((at(now, i) - turned).norm(), kFloat);
  }
}

class DeformFiles : public ::testing::Test {
 protected:
  void write(const char* name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
  }
  std::string path() const { return (folder_.path() / "idea.toml").string(); }

  TemporaryFolder folder_;
};

const char* const kTriangle =
    "type = \"mesh\"\nfile = \"a.obj\"\nmotion.deform = { keyframes = [\n"
    "  { time = 1, file = \"a.obj\" },\n  { time = 2, file = \"b.obj\" } ] }\n"
    "[time]\nframes = 6\ndt = 0.5\n";

TEST_F(DeformFiles, VerticesAreLinearBetweenKeyframesAndHeldAtTheEnds) {
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("b.obj", "v 0 0 1\nv 3 0 0\nv 0 1 -2\nf 1 2 3\n");
  const Scenario scenario = parse_scenario(one_shape(kTriangle), path());
  Runner runner(scenario);
  const std::vector<Vec3d> a = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Vec3d> b = {{0, 0, 1}, {3, 0, 0}, {0, 1, -2}};
  const std::vector<Vec3d> between = {{0, 0, 0.5}, {2, 0, 0}, {0, 1, -1}};
  const std::vector<const std::vector<Vec3d>*> expected = {&a, &a, &a, &between, &b, &b};
  for (int frame = 0; frame < 6; ++frame)
    EXPECT_EQ(vertices_in(runner.frame(frame)), *at(expected, frame)) << frame;
}

TEST_F(DeformFiles, AnotherTopologyIsRefusedWithItsLine) {
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
  const auto complaint_of = [&](const char* other) {
    write("b.obj", other);
    return complaint(one_shape(kTriangle), path());
  };
  const auto is_named = [&](const char* what) {
    return AllOf(StartsWith(path() + ":7:22: "), HasSubstr("'b.obj'"), HasSubstr(what));
  };
  EXPECT_THAT(complaint_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
              is_named("number of vertices is 3 in 'b.obj', and 4 in the mesh"));
  EXPECT_THAT(complaint_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\n"),
              is_named("number of triangles is 1 in 'b.obj', and 2 in the mesh"));
  EXPECT_THAT(complaint_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 2 4 3\nf 1 2 3\n"),
              is_named("write the file with the same faces in the same order"));
}

/// A triangle that moves from a.obj to b.obj, and a wall in the x-z plane.
const char* const kNeedleAndWall = R"(title = "A needle and a wall"
[time]
frames = 2
dt = 1
[pipeline]
scalar = "double"
query = "overlap"
continuous = "time_of_impact"
[shapes.needle]
type = "mesh"
file = "a.obj"
motion.deform = { keyframes = [ { time = 0, file = "a.obj" }, { time = 1, file = "b.obj" } ] }
[shapes.wall]
type = "mesh"
vertices = [[0, 0, 0], [1, 0, 0], [0, 0, 1]]
triangles = [[0, 1, 2]]
)";

TEST_F(DeformFiles, ATriangleWithoutAnAreaMeetsAWallBetweenTwoFrames) {
  // The first of two triangles, and the only one; the other one meets nothing.
  for (const std::string other : {"v 9 9 9\nv 10 9 9\nv 9 9 10\nf 4 5 6\n", ""}) {
    write("a.obj", "v 0.2 1 0.2\nv 0.2 1.5 0.2\nv 0.2 1.25 0.2\nf 1 2 3\n" + other);
    write("b.obj", "v 0.2 -1 0.2\nv 0.2 -0.5 0.2\nv 0.2 -0.75 0.2\nf 1 2 3\n" + other);
    const Scenario scenario = parse_scenario(kNeedleAndWall, path());
    EXPECT_THAT(scenario.warnings, IsEmpty());
    const trace::Frame frame = Runner(scenario).frame(0);
    ASSERT_TRUE(frame.pairs.at(0).impact);
    const trace::Impact& impact = *frame.pairs[0].impact;
    EXPECT_EQ(impact.status, "hit");
    EXPECT_NEAR(impact.time, 0.5, 1e-13);
    EXPECT_LE(impact.time, 0.5);
    EXPECT_EQ(impact.triangle_a, 0);
    EXPECT_EQ(impact.triangle_b, 0);
    EXPECT_NEAR((impact.point_b - Vec3d(0.2, 0, 0.2)).norm(), 0, 1e-12);
    EXPECT_NEAR(std::abs(impact.normal.y()), 1, 1e-12);
  }
}

TEST_F(DeformFiles, AMeshOfATriangleWithoutAnAreaOverlapsAndIsTouched) {
  write("a.obj", "v 0.2 -1 0.2\nv 0.2 1 0.2\nv 0.2 0.5 0.2\nf 1 2 3\n");
  write("b.obj", "v 0.2 1 0.2\nv 0.2 1 0.2\nv 0.2 1 0.2\nf 1 2 3\n");
  const Scenario overlap = parse_scenario(kNeedleAndWall, path());
  Runner runner(overlap);
  EXPECT_EQ(runner.frame(0).pairs.at(0).intersections.size(), 1u);
  EXPECT_TRUE(runner.frame(1).pairs.at(0).intersections.empty());
  std::string text = kNeedleAndWall;
  const std::string requested = "query = \"overlap\"\ncontinuous = \"time_of_impact\"\n";
  text.erase(text.find(requested), requested.size());
  text.resize(text.find("[shapes.wall]"));
  text += "[shapes.ball]\ntype = \"sphere\"\nradius = 0.5\nposition = [0.5, 1.4, 0.2]\n";
  const Scenario contacts = parse_scenario(text, path());
  Runner touched(contacts);
  for (const int frame : {0, 1}) {  // the end of the segment, and the point
    const trace::Pair pair = touched.frame(frame).pairs.at(0);
    ASSERT_EQ(pair.manifolds.size(), 1u);
    ASSERT_EQ(pair.manifolds[0].points.size(), 1u);
    EXPECT_NEAR(pair.manifolds[0].points[0].separation, 0, 1e-15);
    EXPECT_NEAR((pair.manifolds[0].normal - Vec3d(0.6, 0.8, 0)).norm(), 0, 1e-15);
  }
}

class BrokenDeform : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenDeform, IsNamedByPlaceAndRemedy) {
  const std::string message = complaint(GetParam().text);
  EXPECT_THAT(message, StartsWith(std::string("group/idea.toml:") + GetParam().location + ": "));
  EXPECT_THAT(message, HasSubstr(GetParam().remedy));
}

std::string wave(const std::string& keys) {
  return scene("{ wave = { axis = [1, 0, 0], direction = [0, 1, 0], " + keys + " } }");
}

INSTANTIATE_TEST_SUITE_P(
    Deform, BrokenDeform,
    ::testing::Values(
        Broken{"None", scene("{ }"), "5:17",
               "'deform' needs exactly one of 'wave', 'twist' and 'keyframes'"},
        Broken{"Two", scene("{ wave = {}, twist = {} }"), "5:17", "needs exactly one"},
        Broken{"Misspelled", scene("{ wav = {} }"), "5:19", "did you mean 'wave'?"},
        Broken{"NoWavelength", wave("amplitude = 1, speed = 1"), "5:26",
               "missing key 'wavelength' in 'wave'; add wavelength = 1 (1e-9 to 1e9 m)"},
        Broken{"ZeroWavelength", wave("amplitude = 1, wavelength = 0, speed = 1"), "5:97",
               "'wavelength' is 0; it may be 1e-9 to 1e9 m"},
        Broken{"HugeAmplitude", wave("amplitude = 1e10, wavelength = 1, speed = 1"), "5:81",
               "'amplitude' is 1e+10; it may be -1e9 to 1e9 m"},
        Broken{"HugeSpeed", wave("amplitude = 1, wavelength = 1, speed = -1e10"), "5:108",
               "'speed' is -1e+10; it may be -1e9 to 1e9 m/s"},
        Broken{"ZeroAxis", scene("{ twist = { axis = [0, 0, 0], degrees = 1 } }"), "5:36",
               "'axis' is zero; give a direction"},
        Broken{"NoAngle", scene("{ twist = { axis = [0, 1, 0] } }"), "5:27",
               "missing key 'degrees' in 'twist'"},
        Broken{"TwoAngles", scene("{ twist = { axis = [0, 1, 0], degrees = 1, radians = 1 } }"),
               "5:70", "give 'degrees' or 'radians', not both"},
        Broken{"NoKeyframes", scene("{ keyframes = [] }"), "5:31", "'keyframes' is empty"},
        Broken{"NoFile", scene("{ keyframes = [ { time = 0 } ] }"), "5:33",
               "missing key 'file' in 'keyframes[0]'; add file = \"NAME.obj\""},
        Broken{"MissingFile", scene("{ keyframes = [ { time = 0, file = \"no.obj\" } ] }"), "5:52",
               "there is no file"},
        Broken{"OfABox",
               one_shape("type = \"box\"\nhalf_extents = [1, 1, 1]\nmotion.deform = {}\n"), "5:17",
               "'rock' is a box, and only a mesh deforms"},
        Broken{"BesideABody", scene(kWave) + "motion = { dynamic = true, mass = 1 }\n", "5:17",
               "'ball' is dynamic, and the solver does not know the surface velocity of a mesh"},
        Broken{"OfABody",
               one_shape("type = \"box\"\nhalf_extents = [1, 1, 1]\n"
                         "motion = { dynamic = true, mass = 1, deform = {} }\n"),
               "5:47", "leave out 'deform' or 'dynamic'"},
        Broken{"UnknownTree", scene(kWave, "tree = \"never\"\n"), "6:8",
               "unknown tree 'never'; known: 'refit', 'rebuild' and 'auto'"},
        Broken{"TreeOfABox",
               one_shape("type = \"box\"\nhalf_extents = [1, 1, 1]\ntree = \"refit\"\n"), "5:1",
               "unknown key 'tree'"}),
    name_of_test);

TEST(Deform, ATreeWithoutADeformationHasNoEffect) {
  const std::string rigid =
      one_shape("type = \"mesh\"\ngrid = { size = 1, cells = 1 }\ntree = \"refit\"\n");
  EXPECT_THAT(
      parse_scenario(rigid, "a.toml").warnings,
      testing::ElementsAre("line 5: 'tree' has no effect: the mesh does not deform; give it "
                           "motion = { deform = .. }, or remove it"));
  EXPECT_THAT(parse_scenario(scene(kWave, "tree = \"refit\"\n"), "a.toml").warnings, IsEmpty());
}

/// A long strip that is wound up, so that a refitted tree gets worse.
std::string wound(const char* tree) {
  return R"(title = "A strip"
[time]
frames = 40
dt = 0.05
[shapes.strip]
type = "mesh"
grid = { size = [1, 4], cells = [6, 24] }
motion.deform = { twist = { axis = [0, 0, 1], radians = 4 } }
tree = ")" +
         std::string(tree) + R"("
[shapes.ball]
type = "sphere"
radius = 0.25
)";
}

TEST(Deform, TheTreeIsRecordedAndAutoRebuildsItAtThirtyPerCentMore) {
  const Scenario auto_scenario = parse_scenario(wound("auto"), "a.toml");
  const Scenario refit_scenario = parse_scenario(wound("refit"), "a.toml");
  const Scenario rebuild_scenario = parse_scenario(wound("rebuild"), "a.toml");
  Runner chosen(auto_scenario), refit(refit_scenario), rebuild(rebuild_scenario);
  int rebuilt = 0;
  double worst_refit = 0;
  for (int frame = 0; frame < 40; ++frame) {
    const trace::Deformed one = chosen.frame(frame).deformed.at(0);
    const trace::Deformed same = refit.frame(frame).deformed.at(0);
    const trace::Deformed fresh = rebuild.frame(frame).deformed.at(0);
    EXPECT_EQ(one.vertices, same.vertices);
    EXPECT_EQ(one.vertices, fresh.vertices);
    EXPECT_EQ(same.tree, frame == 0 ? "built" : "refitted");
    EXPECT_EQ(fresh.tree, frame == 0 ? "built" : "rebuilt");
    EXPECT_EQ(fresh.cost, fresh.cost_when_built);
    EXPECT_LE(one.cost, kWorstTreeCost * one.cost_when_built);
    EXPECT_TRUE(one.tree != "rebuilt" || one.cost == one.cost_when_built);
    rebuilt += one.tree == "rebuilt" ? 1 : 0;
    worst_refit = std::max(worst_refit, same.cost / same.cost_when_built);
  }
  EXPECT_GT(worst_refit, kWorstTreeCost);
  EXPECT_GE(rebuilt, 1);
  EXPECT_LT(rebuilt, 20);
}

TEST(Deform, ALaterFrameDoesNotDependOnEarlierRequests) {
  const Scenario scenario = parse_scenario(wound("auto"), "a.toml");
  Runner all(scenario), last(scenario);
  for (int frame = 0; frame < 30; ++frame) all.frame(frame);
  EXPECT_EQ(all.frame(30).deformed, last.frame(30).deformed);
  const Runner copy = last;
  Runner goes_on = copy;
  EXPECT_EQ(goes_on.frame(31).deformed, all.frame(31).deformed);
}

TEST(Deform, TheHeaderHasTheShapeOfTheFirstFrame) {
  const Scenario scenario =
      parse_scenario(scene(kWave, "[time]\nframes = 3\ndt = 0.5\n"), "a.toml");
  Runner runner(scenario);
  const std::vector<Vec3d> first = vertices_in(runner.frame(0));
  EXPECT_NE(vertices_in(runner.frame(2)), first);
  EXPECT_EQ(runner.header().shapes.at(0).vertices, first);
  EXPECT_NE(first, at_rest(scenario));
}

TEST(Deform, ContactsAreThoseOfTheSurfaceAsItIs) {
  // The crest that starts under the ball has gone; half a wavelength later a trough is there.
  const std::string text = scene(
      "{ wave = { axis = [1, 0, 0], direction = [0, 1, 0], amplitude = 0.1, wavelength = 2, "
      "speed = 1 } }",
      "position = [-0.5, 0, 0]\n[time]\nframes = 2\ndt = 1\n");
  const Scenario scenario = parse_scenario(text, "a.toml");
  Runner runner(scenario);
  const trace::Pair crest = runner.frame(0).pairs.at(0);
  EXPECT_EQ(crest.state, "touching");
  EXPECT_NEAR(crest.separation, 0.2 - 0.25 - 0.1, 1e-6);  // the vertex below is on the crest
  EXPECT_EQ(runner.frame(1).pairs.at(0).state, "separated");
}

/// A swell that rises from 0.212 m to 0.3 m in a frame, under a ball whose bottom is at 0.25 m.
std::string swell(const std::string& rest) {
  return R"(title = "A swell"
[time]
frames = 2
dt = 1
[shapes.grid]
type = "mesh"
grid = { size = 2, cells = 8 }
motion.deform = { wave = { axis = [1, 0, 0], direction = [0, 1, 0], amplitude = 0.3, wavelength = 8, speed = -1 } }
[shapes.ball]
type = "sphere"
radius = 0.25
position = [0.9, 0.5, 0]
)" + rest;
}

TEST(Deform, ABroadPhaseGoesByTheBoxOfTheFrame) {
  const Scenario scenario =
      parse_scenario(swell("[world]\nbroad_phase = \"brute_force\"\n"), "a.toml");
  Runner runner(scenario);
  const trace::Frame before = runner.frame(0), after = runner.frame(1);
  EXPECT_THAT(before.pairs, IsEmpty());
  ASSERT_EQ(after.pairs.size(), 1u);
  EXPECT_NEAR(before.broad_phase->bounds.at(0).box.upper.y(), 0.3 * std::sqrt(0.5), 1e-4);
  EXPECT_NEAR(after.broad_phase->bounds.at(0).box.upper.y(), 0.3, 1e-4);
}

TEST(Deform, QueriedBoundsAreThoseOfTheFrame) {
  for (const char* bounds : {"aabb", "obb", "sphere"}) {
    const Scenario scenario = parse_scenario(
        swell("[[pairs]]\na = \"grid\"\nb = \"ball\"\nquery = \"overlap\"\nbounds = \"" +
              std::string(bounds) + "\"\n"),
        "a.toml");
    Runner runner(scenario);
    const trace::Pair before = runner.frame(0).pairs.at(0), after = runner.frame(1).pairs.at(0);
    EXPECT_NE(before.query->bounds_a, after.query->bounds_a) << bounds;
    if (bounds != std::string("aabb")) continue;
    EXPECT_EQ(before.overlap, false);
    EXPECT_EQ(after.overlap, true);
  }
}

TEST(Deform, FarFromItsOriginAMeshKeepsItsDigits) {
  const std::string far = R"(title = "far"
[time]
frames = 3
dt = 0.5
[shapes.far]
type = "mesh"
vertices = [[10000, 0, 0], [10000.001, 0, 0], [10000, 0.001, 0]]
triangles = [[0, 1, 2]]
motion.deform = { wave = { axis = [1, 0, 0], direction = [0, 0, 1], amplitude = 1e-4, wavelength = 1e-2, speed = 1e-3 } }
[shapes.ball]
type = "sphere"
radius = 1
)";
  const Scenario scenario = parse_scenario(far, "a.toml");
  ASSERT_TRUE(scenario.shape(0).is_moved());
  Runner runner(scenario);
  const std::vector<Vec3d> now = vertices_in(runner.frame(2));
  const double height = 1e-4 * std::sin(2 * std::numbers::pi * (10000 - 1e-3) / 1e-2);
  EXPECT_NEAR(at(now, 0).z(), height, 1e-13);
  EXPECT_EQ(at(now, 1).x(), 10000.001);
}

}  // namespace
}  // namespace contactscope
