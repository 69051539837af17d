// Continuous collision: its key, rejected uses, and the facts that a run records.

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

TEST(ContinuousKeys, DiscreteHasNoImpact) {
  EXPECT_FALSE(first_frame(crate_over_floor("")).pairs.at(0).impact);
  EXPECT_FALSE(
      first_frame(crate_over_floor("[pipeline]\ncontinuous = \"discrete\"\n")).pairs.at(0).impact);
}

TEST(ContinuousKeys, TheTraceHasTheTimeOfImpact) {
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

TEST(ContinuousKeys, AnEntryAppliesToItsPairAlone) {
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

/// A dynamic body continues its current motion; the solver does not stop it.
TEST(ContinuousKeys, ABodyGoesOnAsItMoves) {
  const std::string weightless = "[world]\ngravity = [0, 0, 0]\n";
  const std::string text =
      "title = \"Falls\"\n[time]\nframes = 2\ndt = 0.5\n[pipeline]\ncontinuous = "
      "\"time_of_impact\"\n"
      "[shapes.ball]\ntype = \"sphere\"\nradius = 0.5\nposition = [0, 2, 0]\n"
      "motion = { dynamic = true, density = 100, velocity = [0, -4, 0], angular_velocity = [3, 0, "
      "0] }\n"
      "[shapes.ground]\ntype = \"plane\"\nnormal = [0, 1, 0]\noffset = 0.5\n";
  const trace::Frame frame = first_frame(text + weightless);
  ASSERT_TRUE(frame.pairs.at(0).impact);
  EXPECT_EQ(frame.pairs[0].impact->status, "hit");
  EXPECT_NEAR(frame.pairs[0].impact->time, 0.5, 1e-4);
  EXPECT_NEAR(frame.pairs[0].impact->travel_a.turn.x(), 1.5, 1e-6);
  // Its weight moves it dt^2 g farther, as in the solver's first step.
  EXPECT_NEAR(first_frame(text).pairs.at(0).impact->travel_a.displacement.y(), -2 - 0.25 * 9.81,
              1e-5);
}

/// A ball that flies at a thin wall, 1 m a step, and would pass it.
std::string shot(const std::string& method, const std::string& rest = "") {
  return "title = \"Shot\"\n[time]\nframes = 4\ndt = 0.01\n[world]\ngravity = [0, 0, 0]\n"
         "[pipeline]\ncontinuous = \"" +
         method +
         "\"\n[shapes.ball]\ntype = \"sphere\"\nradius = 0.1\nposition = [-0.6, 0, 0]\n"
         "motion = { dynamic = true, mass = 1, velocity = [100, 0, 0] }\n"
         "[shapes.wall]\ntype = \"box\"\nhalf_extents = [0.005, 1, 1]\n" +
         rest;
}

/// Position of the ball along its path after two steps.
double end_of(const std::string& text) {
  const Scenario scenario = parse_scenario(text, "g/a.toml");
  return Runner(scenario).frame(2).poses.at(0).second.position.x();
}

TEST(ContinuousKeys, TheSolverStopsImpactsBetweenFrames) {
  EXPECT_NEAR(end_of(shot("discrete")), 1.4, 1e-5);
  for (const std::string method :
       {"speculative", "swept", "conservative_advancement", "time_of_impact"})
    EXPECT_NEAR(end_of(shot(method)), -0.105, 0.01) << method;
}

TEST(ContinuousKeys, TheTraceHasTheStops) {
  const trace::Frame frame = first_frame(shot("time_of_impact"));
  ASSERT_TRUE(frame.solver);
  ASSERT_EQ(frame.solver->stops.size(), 1u);
  const trace::Stop& stop = frame.solver->stops[0];
  EXPECT_EQ(stop.a, "ball");
  EXPECT_EQ(stop.b, "wall");
  EXPECT_NEAR(stop.time, 0.495, 0.005);
  EXPECT_NEAR(stop.normal.x(), 1, 1e-6);
  EXPECT_TRUE(first_frame(shot("speculative")).solver->stops.empty());
}

/// A broad phase of the current boxes would not even find the pair.
TEST(ContinuousKeys, ABroadPhaseCoversTheStep) {
  std::string text = shot("time_of_impact");
  text.replace(text.find("gravity"), 0, "broad_phase = \"tree\"\n");
  EXPECT_NEAR(end_of(text), -0.105, 0.01);
  EXPECT_EQ(first_frame(text).pairs.size(), 1u);
}

/// The ball flies past the wall's edge, but the plane of the wall's face blocks it.
TEST(ContinuousKeys, GhostsAreCounted) {
  std::string text = shot("speculative");
  text.replace(text.find("[-0.6, 0, 0]"), 12, "[-0.6, 0.8, 0]");
  text.replace(text.find("[100, 0, 0]"), 11, "[100, 60, 0]");
  const trace::Frame frame = first_frame(text);
  ASSERT_TRUE(frame.pairs.at(0).impact);
  EXPECT_EQ(frame.pairs[0].impact->status, "separated");
  ASSERT_EQ(frame.pairs[0].impact->ghosts.size(), 1u);
  EXPECT_NEAR(frame.pairs[0].impact->margin, 0.01 * std::hypot(100, 60), 1e-5);
  ASSERT_EQ(frame.pairs[0].manifolds.size(), 1u);
  EXPECT_EQ(frame.pairs[0].impact->ghosts[0], frame.pairs[0].manifolds[0].points.at(0).position);
  const trace::Frame hit = first_frame(shot("speculative"));
  EXPECT_TRUE(hit.pairs.at(0).impact->ghosts.empty());
}

TEST(ContinuousKeys, ImpactsBetweenFramesCanBeExpected) {
  const auto failures = [](const std::string& method, const std::string& expected) {
    const Scenario scenario = parse_scenario(
        shot(method, "[[expect]]\na = \"ball\"\nb = \"wall\"\nframes = [0, 0]\n" + expected),
        "g/a.toml");
    return unmet_expectations(scenario, {Runner(scenario).frame(0)});
  };
  EXPECT_THAT(failures("time_of_impact",
                       "impact = \"hit\"\nimpact_time = 0.495\nstops = 1\ntolerance = 1e-4\n"),
              testing::IsEmpty());
  EXPECT_THAT(failures("speculative", "ghosts = 0\nimpact = \"hit\"\n"), testing::IsEmpty());
  EXPECT_THAT(failures("time_of_impact", "impact = \"separated\"\n"), testing::SizeIs(1));
  EXPECT_THAT(failures("time_of_impact", "impact_time = 0.4\n"), testing::SizeIs(1));
  EXPECT_THAT(failures("time_of_impact", "stops = 0\n"), testing::SizeIs(1));
  EXPECT_THAT(failures("speculative", "ghosts = 1\n"), testing::SizeIs(1));
}

/// A field is hit at its surface, and overlaps with anything inside.
TEST(ContinuousKeys, AFieldIsMetWhereItsSurfaceIs) {
  const auto impact_of = [](const std::string& position) {
    const trace::Frame frame = first_frame(
        "title = \"Field\"\n[time]\nframes = 2\ndt = 1\n[pipeline]\ncontinuous = "
        "\"time_of_impact\"\n[shapes.ball]\ntype = \"sphere\"\nradius = 0.1\nposition = " +
        position +
        "\nmotion = { velocity = [0, -4, 0] }\n[shapes.solid]\ntype = \"sdf\"\ncells = 16\n"
        "of = { type = \"box\", half_extents = [1, 1, 1] }\n");
    return frame.pairs.at(0).impact.value_or(trace::Impact{});
  };
  const trace::Impact outside = impact_of("[0.3, 3.1, 0.2]");
  EXPECT_EQ(outside.status, "hit");
  EXPECT_NEAR(outside.time, 0.5, 1e-4);
  EXPECT_EQ(impact_of("[0.3, 0, 0.2]").status, "overlapping");
}

/// A flag on a pole makes half a turn and passes over a rock. On straight paths between the frames
/// its corners would pass through the pole and miss the rock. Both are meshes.
TEST(ContinuousKeys, MeshesThatTurnAreFollowedOnTheirArcs) {
  for (const std::string method : {"conservative_advancement", "time_of_impact"}) {
    const trace::Frame frame = first_frame(
        "title = \"Flag\"\n[time]\nframes = 2\ndt = 1\n[shapes.flag]\ntype = \"mesh\"\nvertices = "
        "[[1, 0, "
        "-0.1], [1.2, 0, -0.1], [1.1, 0, 0.1]]\ntriangles = [[0, 1, 2]]\nmotion = { "
        "angular_velocity = "
        "[0, 3, 0] }\n[shapes.rock]\ntype = \"mesh\"\nvertices = [[-0.1, -1, -1.1], [0.1, -1, "
        "-1.1], "
        "[0, 1, -1.1]]\ntriangles = [[0, 1, 2]]\n[[pairs]]\na = \"flag\"\nb = \"rock\"\nquery = "
        "\"overlap\"\ncontinuous = \"" +
        method + "\"\n");
    ASSERT_TRUE(frame.pairs.at(0).impact);
    const trace::Impact& impact = *frame.pairs[0].impact;
    EXPECT_EQ(impact.status, "hit");
    EXPECT_EQ(impact.triangle_a, 0);
    EXPECT_EQ(impact.triangle_b, 0);
    EXPECT_TRUE(impact.corners_a.empty());
    EXPECT_FALSE(impact.distances.empty());
    EXPECT_GT(impact.time, 0.4);
    EXPECT_LT(impact.time, 0.6);
  }
}

/// In a step of 100,000 km, float rounds by more than the separation; the search runs in double.
TEST(ContinuousKeys, ADisplacementThatHidesTheGapIsNoOverlap) {
  std::string text = crate_over_floor("[pipeline]\ncontinuous = \"time_of_impact\"\n");
  text.replace(text.find("[0, -4, 0]"), 10, "[0, -2e8, 0]");
  const trace::Frame frame = first_frame(text);
  ASSERT_TRUE(frame.pairs.at(0).impact);
  EXPECT_EQ(frame.pairs[0].impact->status, "hit");
  EXPECT_GE(frame.pairs[0].impact->time, 0);
  EXPECT_LE(frame.pairs[0].impact->time, 1e-8);  // a separation of 1 m in a step of 1e8 m
}

/// A sheet that descends on another one and bends: its crest is first.
TEST(ContinuousKeys, TwoMeshesThatDeformMeetAtTheirCorners) {
  const std::string sheet = "type = \"mesh\"\ngrid = { size = 2, cells = 8 }\n";
  const trace::Frame frame =
      first_frame("title = \"Sheets\"\n[time]\nframes = 2\ndt = 1\n[shapes.upper]\n" + sheet +
                  "position = [0.03, 1, 0.02]\nmotion = { velocity = [0, -2, 0], deform = { wave = "
                  "{ axis = [1, 0, "
                  "0], direction = [0, 1, 0], amplitude = 0.25, wavelength = 1, speed = 0 } } }\n"
                  "[shapes.lower]\n" +
                  sheet +
                  "[[pairs]]\na = \"upper\"\nb = \"lower\"\nquery = \"overlap\"\ncontinuous = "
                  "\"time_of_impact\"\n");
  ASSERT_TRUE(frame.pairs.at(0).impact);
  const trace::Impact& impact = *frame.pairs[0].impact;
  EXPECT_EQ(impact.status, "hit");
  EXPECT_NEAR(impact.time, 0.375, 1e-6);  // the troughs are .75 m over the lower sheet
  EXPECT_NEAR(impact.normal.y(), -1, 1e-6);
  EXPECT_NEAR((impact.point_a - impact.point_b).norm(), 0, 1e-6);
  EXPECT_NEAR(impact.point_a.y(), 0, 1e-6);
  ASSERT_EQ(impact.corners_a.size(), 3u);
  ASSERT_EQ(impact.corners_b.size(), 3u);
  EXPECT_GE(impact.triangle_a, 0);
  EXPECT_GE(impact.triangle_b, 0);
  EXPECT_EQ(impact.triangle, -1);
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
        Broken{"ImpactOfDiscretePair",
               two_boxes("[[expect]]\na = \"crate\"\nb = \"floor\"\nimpact = \"hit\"\n"), "11:10",
               "set 'continuous'"},
        Broken{
            "StopsWithoutBodies",
            two_boxes("[pipeline]\ncontinuous = \"time_of_impact\"\n[[expect]]\na = \"crate\"\nb = "
                      "\"floor\"\nstops = 1\n"),
            "13:9", "neither shape is dynamic"},
        Broken{
            "GhostsOfOthers",
            two_boxes("[pipeline]\ncontinuous = \"time_of_impact\"\n[[expect]]\na = \"crate\"\nb = "
                      "\"floor\"\nghosts = 1\n"),
            "13:10", "speculative"},
        Broken{
            "TimeBeyondTheStep",
            two_boxes("[pipeline]\ncontinuous = \"time_of_impact\"\n[[expect]]\na = \"crate\"\nb = "
                      "\"floor\"\nimpact_time = 2\n"),
            "13:15", "'impact_time' is 2; it may be 0 to 1"},
        Broken{"MeshesThatDeformByAnotherWay",
               "title = \"Meshes\"\n[shapes.floor]\ntype = \"mesh\"\ngrid = { size = 2, cells = 2 "
               "}\n[shapes.wall]\ntype = \"mesh\"\ngrid = { size = 1, cells = 1 }\n"
               "motion.deform = { twist = { axis = [0, 1, 0], degrees = 90 } }\n"
               "[[pairs]]\na = \"floor\"\nb = \"wall\"\nquery = \"overlap\"\n"
               "continuous = \"swept\"\n",
               "13:14", "set continuous = \"time_of_impact\""},
        Broken{"AMeshThatDeforms",
               two_boxes("[shapes.sheet]\ntype = \"mesh\"\ngrid = { size = 2, cells = 2 }\n"
                         "motion.deform = { twist = { axis = [0, 1, 0], degrees = 90 } }\n"
                         "[[pairs]]\na = \"crate\"\nb = \"sheet\"\n"
                         "continuous = \"time_of_impact\"\n"),
               "15:14", "deforms between frames"}),
    [](const auto& test) { return name_of_test(test); });

}  // namespace
}  // namespace contactscope
