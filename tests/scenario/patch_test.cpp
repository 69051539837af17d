#include <gmock/gmock.h>

#include "scenario/broken.h"
#include "scenario/run.h"

namespace contactscope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

/// Five points; the third is the deepest, and inside the square of the others.
std::string five(const std::string& rest = "", const std::string& before = "") {
  return before + R"([[patch]]
normal = [0, 2, 0]
points = [[1, 0, 1, 0.001], [1, 0, -1, 0], [0, 0, 0.1, -0.004], [-1, 0, -1, 0], [-1, 0, 1, -0.002]]
)" + rest;
}

trace::Frame frame_of(const Scenario& scenario) { return Runner(scenario).frame(0); }

TEST(Patch, IsAFileWithoutShapesTitleOrPairs) {
  const Scenario scenario = parse_scenario(five(), "mine/five.toml");
  EXPECT_EQ(scenario.name, "mine/five");
  EXPECT_EQ(scenario.title, "patch 1");
  EXPECT_THAT(scenario.shapes, IsEmpty());
  EXPECT_THAT(scenario.pairs, IsEmpty());
  ASSERT_THAT(scenario.patches, SizeIs(1));
  EXPECT_EQ(scenario.patches[0].normal, Vec3d(0, 1, 0));
  EXPECT_THAT(scenario.patches[0].points, SizeIs(5));
  EXPECT_EQ(scenario.patches[0].points[2].position, Vec3d(0, 0, 0.1));
  EXPECT_EQ(scenario.patches[0].points[2].separation, -0.004);
  ASSERT_THAT(scenario.views, SizeIs(1));
  EXPECT_EQ(scenario.views[0].kind, ViewKind::ContactPlane);
}

TEST(Patch, TitlesAndNamesAreThoseOfTheFile) {
  const Scenario scenario = parse_scenario(
      five("name = \"mine\"\n[[patch]]\nnormal = [0, 0, 1]\npoints = [[0, 0, 0, 0]]\n",
           "title = \"Twice\"\nsource = \"A talk\"\n"),
      "mine/two.toml");
  EXPECT_EQ(scenario.title, "Twice");
  EXPECT_EQ(scenario.source, "A talk");
  ASSERT_THAT(scenario.patches, SizeIs(2));
  EXPECT_EQ(scenario.patches[0].name, "mine");
  EXPECT_EQ(scenario.patches[1].name, "patch 2");
}

TEST(Patch, FrameHasItsReductionAsAPairWithoutShapes) {
  const trace::Frame frame = frame_of(parse_scenario(five(), "mine/five.toml"));
  EXPECT_THAT(frame.poses, IsEmpty());
  ASSERT_THAT(frame.pairs, SizeIs(1));
  const trace::Pair& pair = frame.pairs[0];
  EXPECT_EQ(pair.label, "patch 1");
  EXPECT_EQ(pair.separation, static_cast<double>(-0.004f));
  ASSERT_TRUE(pair.reduction);
  EXPECT_EQ(pair.reduction->method, "optimal_deepest");
  EXPECT_THAT(pair.reduction->points, SizeIs(5));
  EXPECT_THAT(pair.reduction->kept, testing::Contains(2));
  EXPECT_EQ(pair.reduction->points[2].id, "3");
  ASSERT_THAT(pair.manifolds, SizeIs(1));
  EXPECT_THAT(pair.manifolds[0].points, SizeIs(4));
}

TEST(Patch, GoesByTheReducerTheScalarAndTheNumberOfPoints) {
  const Scenario scenario =
      parse_scenario(five("[pipeline]\nscalar = \"double\"\nreducer = \"first\"\nmax_points = 2\n"),
                     "mine/five.toml");
  EXPECT_THAT(scenario.warnings, IsEmpty());
  const trace::Frame frame = frame_of(scenario);
  EXPECT_THAT(frame.pairs.at(0).reduction.value().kept, ElementsAre(0, 1));
  EXPECT_EQ(frame.pairs.at(0).reduction->points[4].separation, -0.002);
}

TEST(Patch, SettingsOfHowPointsAreFoundAreWarnedOf) {
  const Scenario scenario = parse_scenario(five("[pipeline]\nmargin = 0.1\n"), "mine/five.toml");
  ASSERT_THAT(scenario.warnings, SizeIs(1));
  EXPECT_THAT(scenario.warnings[0], StartsWith("line 5: 'margin' has no effect"));
}

class BrokenPatch : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenPatch, IsNamedByPlaceAndRemedy) {
  const std::string message = complaint(GetParam().text);
  EXPECT_THAT(message, StartsWith(std::string("group/idea.toml:") + GetParam().location + ": "));
  EXPECT_THAT(message, HasSubstr(GetParam().remedy));
}

INSTANTIATE_TEST_SUITE_P(
    Patches, BrokenPatch,
    ::testing::Values(
        Broken{"NoPatch", "patch = []\n", "1:9", "'patch' is empty; add a [[patch]]"},
        Broken{"ATable", "[patch]\nnormal = [0, 1, 0]\n", "1:1", "written as [[patch]]"},
        Broken{"NoNormal", "[[patch]]\npoints = [[0, 0, 0, 0]]\n", "1:1",
               "missing key 'normal' in 'patch[0]'"},
        Broken{"NoPoints", "[[patch]]\nnormal = [0, 1, 0]\n", "1:1", "missing key 'points'"},
        Broken{"EmptyPoints", "[[patch]]\nnormal = [0, 1, 0]\npoints = []\n", "3:10",
               "'points' is empty; a patch has at least one"},
        Broken{"ZeroNormal", "[[patch]]\nnormal = [0, 0, 0]\npoints = [[0, 0, 0, 0]]\n", "2:10",
               "'normal' is zero"},
        Broken{"NoSeparation",
               "[[patch]]\nnormal = [0, 1, 0]\npoints = [[0, 0, 0, 0], [1, 0, 0]]\n", "3:25",
               "write [x, y, z, separation]"},
        Broken{"NotFinite", "[[patch]]\nnormal = [0, 1, 0]\npoints = [[0, 0, 0, nan]]\n", "3:21",
               "not a number (nan)"},
        Broken{"TooFar", "[[patch]]\nnormal = [0, 1, 0]\npoints = [[0, 0, 2e9, 0]]\n", "3:18",
               "it may be -1e9 to 1e9 m"},
        Broken{"SameName", five("name = \"x\"\n" + five("name = \"x\"\n")), "5:1",
               "two patches are named 'x'"},
        Broken{"BesideShapes", five("[shapes.a]\ntype = \"sphere\"\nradius = 1\n"), "4:1",
               "'shapes' needs shapes, and a file of [[patch]] has only points"},
        Broken{"BesideTime", five("[time]\nframes = 3\n"), "4:1", "remove it, or the patches"},
        Broken{"SceneView", five("[[views]]\nlayers = [\"contacts\"]\n"), "4:1",
               "set kind = \"contact_plane\""},
        Broken{"UnknownKey", "[[patch]]\npoint = [[0, 0, 0, 0]]\n", "2:1",
               "unknown key 'point'; did you mean 'points'?"}),
    name_of_test);

}  // namespace
}  // namespace contactscope
