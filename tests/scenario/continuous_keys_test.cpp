// What happens between frames: the key, what is refused, and what a run tells.

#include <gmock/gmock.h>

#include "scenario/broken.h"
#include "scenario/run.h"

namespace contactscope {
namespace {

using testing::HasSubstr;

trace::Frame first_frame(const std::string& text) {
  const Scenario scenario = parse_scenario(text, "group/idea.toml");
  return Runner(scenario).frame(0);
}

/// A crate that falls 2 m in the step, 1 m over the floor.
std::string crate_over_floor(const std::string& rest) {
  return "title = \"Falls\"\n[time]\nframes = 2\ndt = 0.5\n"
         "[shapes.crate]\ntype = \"box\"\nhalf_extents = [0.5, 0.5, 0.5]\nposition = [0, 2, 0]\n"
         "motion = { velocity = [0, -4, 0] }\n"
         "[shapes.floor]\ntype = \"box\"\nhalf_extents = [2, 0.5, 2]\n" +
         rest;
}

TEST(ContinuousKeys, DiscreteAsksNothing) {
  EXPECT_FALSE(first_frame(crate_over_floor("")).pairs.at(0).impact);
  EXPECT_FALSE(
      first_frame(crate_over_floor("[pipeline]\ncontinuous = \"discrete\"\n")).pairs.at(0).impact);
}

TEST(ContinuousKeys, TheTraceTellsWhenAPairMeets) {
  for (const std::string method : {"conservative_advancement", "time_of_impact"}) {
    const trace::Frame frame =
        first_frame(crate_over_floor("[pipeline]\ncontinuous = \"" + method + "\"\n"));
    ASSERT_TRUE(frame.pairs.at(0).impact) << method;
    const trace::Impact& impact = *frame.pairs[0].impact;
    EXPECT_EQ(impact.method, method);
    EXPECT_EQ(impact.status, "hit");
    EXPECT_NEAR(impact.time, 0.5, 1e-4);
    EXPECT_LE(impact.time, 0.5);
    EXPECT_NEAR(impact.normal.y(), -1, 1e-5);  // from the crate to the floor
    EXPECT_NEAR(impact.point_b.y(), 0.5, 1e-4);
    EXPECT_NEAR(impact.travel_a.displacement.y(), -2, 1e-6);
    EXPECT_TRUE(impact.travel_b.displacement.isZero(0));
    ASSERT_FALSE(impact.steps.empty());
    EXPECT_NEAR(impact.steps[0].distance, 1, 1e-5);
    ASSERT_EQ(impact.distances.size(), 65u);
    EXPECT_NEAR(impact.distances[16].distance, 0.5, 1e-5);
    EXPECT_EQ(impact.distances[64].distance, 0);
  }
}

TEST(ContinuousKeys, AnEntryAsksItOfItsPairAlone) {
  const std::string text = crate_over_floor(
      "[shapes.wall]\ntype = \"plane\"\nnormal = [1, 0, 0]\noffset = -3\n"
      "[[pairs]]\na = \"crate\"\nb = \"wall\"\n"
      "[[pairs]]\na = \"crate\"\nb = \"floor\"\nquery = \"distance\"\n"
      "continuous = \"time_of_impact\"\n");
  const trace::Frame frame = first_frame(text);
  EXPECT_FALSE(frame.pairs.at(0).impact);
  ASSERT_TRUE(frame.pairs.at(1).impact);
  EXPECT_EQ(frame.pairs[1].impact->status, "hit");
}

/// A dynamic body goes on as it moves; the solver is not there to stop it.
TEST(ContinuousKeys, ABodyGoesOnAsItMoves) {
  const std::string text =
      "title = \"Falls\"\n[time]\nframes = 2\ndt = 0.5\n[pipeline]\ncontinuous = "
      "\"time_of_impact\"\n"
      "[shapes.ball]\ntype = \"sphere\"\nradius = 0.5\nposition = [0, 2, 0]\n"
      "motion = { dynamic = true, density = 100, velocity = [0, -4, 0], angular_velocity = [3, 0, "
      "0] }\n"
      "[shapes.ground]\ntype = \"plane\"\nnormal = [0, 1, 0]\noffset = 0.5\n";
  const trace::Frame frame = first_frame(text);
  ASSERT_TRUE(frame.pairs.at(0).impact);
  EXPECT_EQ(frame.pairs[0].impact->status, "hit");
  EXPECT_NEAR(frame.pairs[0].impact->time, 0.5, 1e-4);
  EXPECT_NEAR(frame.pairs[0].impact->travel_a.turn.x(), 1.5, 1e-6);
}

class BrokenContinuous : public testing::TestWithParam<Broken> {};

TEST_P(BrokenContinuous, IsRefusedWithPlaceAndRemedy) {
  const std::string message = complaint(GetParam().text);
  EXPECT_THAT(message, HasSubstr(std::string("group/idea.toml:") + GetParam().location + ": "));
  EXPECT_THAT(message, HasSubstr(GetParam().remedy));
}

INSTANTIATE_TEST_SUITE_P(
    Keys, BrokenContinuous,
    testing::Values(
        Broken{"Unknown", two_boxes("[pipeline]\ncontinuous = \"ccd\"\n"), "9:14",
               "'time_of_impact'"},
        Broken{"TwoMeshes",
               "title = \"Meshes\"\n[shapes.floor]\ntype = \"mesh\"\ngrid = { size = 2, cells = 2 "
               "}\n[shapes.wall]\ntype = \"mesh\"\ngrid = { size = 1, cells = 1 }\n"
               "[[pairs]]\na = \"floor\"\nb = \"wall\"\nquery = \"overlap\"\n"
               "continuous = \"time_of_impact\"\n",
               "12:14", "remove 'continuous'"},
        Broken{"AMeshThatDeforms",
               two_boxes("[shapes.sheet]\ntype = \"mesh\"\ngrid = { size = 2, cells = 2 }\n"
                         "motion.deform = { twist = { axis = [0, 1, 0], degrees = 90 } }\n"
                         "[[pairs]]\na = \"crate\"\nb = \"sheet\"\n"
                         "continuous = \"time_of_impact\"\n"),
               "15:14", "changes its form"}),
    [](const auto& test) { return name_of_test(test); });

}  // namespace
}  // namespace contactscope
