// Queries of pairs: each key, rejected uses, keys without effect, and the answers of a run.

#include <gmock/gmock.h>

#include <algorithm>

#include "broadphase/broad_phase.h"
#include "scenario/broken.h"
#include "scenario/run.h"
#include "support/cases.h"

namespace contactscope {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Scenario parsed(const std::string& text) { return parse_scenario(text, "group/idea.toml"); }

const std::string kFloorAndWall =
    "title = \"Meshes\"\n"
    "[shapes.floor]\ntype = \"mesh\"\ngrid = { size = 2, cells = 2 }\n"
    "[shapes.wall]\ntype = \"mesh\"\ngrid = { size = 1, cells = 1 }\n"
    "rotation = { axis = [0, 0, 1], degrees = 90 }\n";
const std::string kGround = "[shapes.ground]\ntype = \"plane\"\nnormal = [0, 1, 0]\noffset = 0\n";

TEST(QueryKeys, AreReadAndOverriddenPairByPair) {
  const Scenario scenario = parsed(two_boxes(
      "[pipeline]\nquery = \"overlap\"\nbounds = \"obb\"\naxes = \"fifteen\"\nskip_up_to = 0.001\n"
      "[[pairs]]\na = \"crate\"\nb = \"floor\"\n"
      "[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = \"2\"\ncomparison = \"exclusive\"\n"
      "axes = \"faces\"\n"
      "[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = \"3\"\nquery = \"touching\"\n"
      "bounds = \"sphere\"\ntolerance = 0.25\n"));
  const Question& first = scenario.pairs[0].pipeline.question;
  EXPECT_EQ(first.kind, QueryKind::Overlap);
  EXPECT_EQ(first.bounds, QueryMethod::Obb);
  EXPECT_EQ(first.test.axes, ObbAxes::Fifteen);
  EXPECT_EQ(first.test.skip_up_to, 0.001);
  EXPECT_TRUE(first.inclusive());
  const Question& second = scenario.pairs[1].pipeline.question;
  EXPECT_FALSE(second.inclusive());
  EXPECT_EQ(second.test.axes, ObbAxes::Faces);
  const Question& third = scenario.pairs[2].pipeline.question;
  EXPECT_EQ(third.kind, QueryKind::Touching);
  EXPECT_EQ(third.bounds, QueryMethod::BoundingSphere);
  EXPECT_EQ(third.tolerance, 0.25);
  const Scenario without = parsed(two_boxes());
  EXPECT_EQ(without.pairs[0].pipeline.question, Question{});
  EXPECT_TRUE(without.pairs[0].pipeline.makes_contacts());
}

class BrokenQuery : public testing::TestWithParam<Broken> {};

TEST_P(BrokenQuery, IsRefusedWithPlaceAndRemedy) {
  const std::string message = complaint(GetParam().text);
  EXPECT_THAT(message, HasSubstr(std::string("group/idea.toml:") + GetParam().location + ": "));
  EXPECT_THAT(message, HasSubstr(GetParam().remedy));
}

std::string pair(const std::string& keys) {
  return "[[pairs]]\na = \"crate\"\nb = \"floor\"\n" + keys;
}
std::string meshes(const std::string& keys) {
  return kFloorAndWall + "[[pairs]]\na = \"floor\"\nb = \"wall\"\n" + keys;
}

INSTANTIATE_TEST_SUITE_P(
    Keys, BrokenQuery,
    testing::Values(
        Broken{"UnknownQuery", two_boxes(pair("query = \"depth\"\n")), "11:9", "'penetration'"},
        Broken{"UnknownBounds", two_boxes(pair("bounds = \"kdop\"\n")), "11:10", "'sphere'"},
        Broken{"UnknownComparison", two_boxes(pair("comparison = \"strict\"\n")), "11:14",
               "'exclusive'"},
        Broken{"UnknownAxes", two_boxes(pair("axes = \"nine\"\n")), "11:8", "'guarded'"},
        Broken{"NegativeTolerance", two_boxes(pair("tolerance = -1\n")), "11:13",
               "it may be 0 to 1e9 m"},
        Broken{"LargeThreshold", two_boxes(pair("skip_up_to = 2\n")), "11:14", "1"},
        Broken{
            "ExclusiveTolerance",
            two_boxes(pair("query = \"overlap\"\ncomparison = \"exclusive\"\ntolerance = 0.1\n")),
            "13:13", "remove 'tolerance'"},
        Broken{"BoundsHaveNoContacts", two_boxes(pair("bounds = \"aabb\"\n")), "11:10",
               "set query = \"overlap\""},
        Broken{"BoundsHaveNoDepth", two_boxes(pair("query = \"penetration\"\nbounds = \"aabb\"\n")),
               "11:9", "remove 'bounds'"},
        Broken{"MeshesHaveNoDistance", meshes("query = \"distance\"\n"), "12:9",
               "query = \"overlap\""},
        Broken{"MeshesAreExact", meshes("query = \"overlap\"\ntolerance = 0.1\n"), "12:9",
               "compared exactly"},
        Broken{"PlanesHaveNoBounds",
               two_boxes(kGround + "[[pairs]]\na = \"crate\"\nb = \"ground\"\nquery = \"overlap\"\n"
                                   "bounds = \"obb\"\n"),
               "15:9", "no bounds"},
        Broken{"ContactsAreNotAsked",
               two_boxes("[pipeline]\nquery = \"distance\"\n[[expect]]\na = \"crate\"\n"
                         "b = \"floor\"\npoints = 0\n"),
               "13:10", "expect overlap"},
        Broken{"OverlapIsNotAsked",
               two_boxes("[[expect]]\na = \"crate\"\nb = \"floor\"\noverlap = true\n"), "11:11",
               "set query = \"overlap\""},
        Broken{"TouchingIsNotAsked",
               two_boxes("[pipeline]\nquery = \"distance\"\n[[expect]]\na = \"crate\"\n"
                         "b = \"floor\"\ntouching = true\n"),
               "13:12", "query = \"touching\""},
        Broken{"BoxesHaveNoTriangles",
               two_boxes("[pipeline]\nquery = \"overlap\"\n[[expect]]\na = \"crate\"\n"
                         "b = \"floor\"\nintersections = 0\n"),
               "13:17", "'crate' is not a mesh; expect overlap"},
        Broken{"BoundsHaveNoTriangles",
               meshes("query = \"overlap\"\nbounds = \"aabb\"\n[[expect]]\na = \"floor\"\n"
                      "b = \"wall\"\nintersections = 0\n"),
               "17:17", "remove 'bounds'"}),
    name_of_test);

TEST(QueryKeys, UnsupportedDefaultPairsAreOmittedWithAWarning) {
  const Scenario contacts = parsed(kFloorAndWall);
  EXPECT_THAT(contacts.pairs, IsEmpty());
  EXPECT_THAT(contacts.warnings,
              ElementsAre(AllOf(HasSubstr("mesh-mesh pairs are not collided, and left out"),
                                HasSubstr("query = \"overlap\""))));
  const Scenario overlap = parsed(kFloorAndWall + "[pipeline]\nquery = \"overlap\"\n");
  EXPECT_EQ(overlap.pairs.size(), 1u);
  EXPECT_THAT(overlap.warnings, Not(Contains(HasSubstr("left out"))));
  const Scenario bounds =
      parsed(two_boxes(kGround + "[pipeline]\nquery = \"overlap\"\nbounds = \"aabb\"\n"));
  EXPECT_EQ(bounds.pairs.size(), 1u);
  EXPECT_THAT(bounds.warnings, ElementsAre(HasSubstr("a plane has no end")));
}

std::vector<std::string> idle(const std::string& keys) {
  return parsed(two_boxes("[pipeline]\n" + keys)).warnings;
}

TEST(QueryKeys, WithoutEffectWarn) {
  EXPECT_THAT(idle("comparison = \"exclusive\"\n"),
              ElementsAre(AllOf(HasSubstr("line 9: 'comparison' has no effect"),
                                HasSubstr("set query = \"overlap\""))));
  EXPECT_THAT(idle("query = \"distance\"\ntolerance = 0.1\n"),
              ElementsAre(HasSubstr("'tolerance' has no effect")));
  EXPECT_THAT(idle("query = \"overlap\"\naxes = \"faces\"\n"),
              ElementsAre(HasSubstr("set bounds = \"obb\"")));
  EXPECT_THAT(idle("query = \"overlap\"\nbounds = \"obb\"\nskip_up_to = 0.1\n"),
              ElementsAre(HasSubstr("set axes = \"fifteen\"")));
  EXPECT_THAT(
      idle("query = \"overlap\"\nreducer = \"area\"\nmargin = 0.1\n"),
      ElementsAre(HasSubstr("'reducer' has no effect"), HasSubstr("'margin' has no effect")));
  EXPECT_THAT(idle("query = \"overlap\"\npenetration = \"epa\"\n"),
              ElementsAre(HasSubstr("makes no contacts")));
  EXPECT_THAT(idle("query = \"penetration\"\npenetration = \"epa\"\n"), IsEmpty());
  EXPECT_THAT(idle("query = \"overlap\"\ntolerance = 0.1\n"), IsEmpty());
  EXPECT_THAT(idle("reducer = \"area\"\nmargin = 0.1\nmax_points = 2\n"), IsEmpty());
}

TEST(QueryKeys, ARunAnswersWatchedOrNot) {
  const Scenario scenario = parsed(
      two_boxes("position = [0, -1.125, 0]\n"
                "[[pairs]]\na = \"crate\"\nb = \"floor\"\nquery = \"distance\"\n"
                "[[pairs]]\na = \"floor\"\nb = \"crate\"\nlabel = \"bounds\"\nquery = \"overlap\"\n"
                "bounds = \"sphere\"\n"
                "[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = \"contacts\"\n"));
  const trace::Frame frame = Runner(scenario).frame(0);
  ASSERT_EQ(frame.pairs.size(), 3u);
  EXPECT_EQ(frame.pairs[0].overlap, false);
  EXPECT_EQ(frame.pairs[0].separation, 0.125);
  EXPECT_EQ(frame.pairs[0].query->method, "gjk");
  EXPECT_EQ(*frame.pairs[0].query->normal, Vec3d(0, -1, 0));
  EXPECT_EQ(frame.pairs[1].a, "floor");
  EXPECT_EQ(frame.pairs[1].overlap, true);
  EXPECT_FALSE(frame.pairs[1].query->shapes->overlap);
  EXPECT_NEAR(*frame.pairs[1].query->bounds_b->radius, std::sqrt(0.75), 1e-6);
  EXPECT_FALSE(frame.pairs[2].overlap.has_value());
  const trace::Frame unwatched = Runner(scenario).frame_unrecorded(0);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(unwatched.pairs[i].overlap, frame.pairs[i].overlap);
    EXPECT_EQ(unwatched.pairs[i].state, frame.pairs[i].state);
    EXPECT_EQ(unwatched.pairs[i].kind, frame.pairs[i].kind);
    EXPECT_FALSE(unwatched.pairs[i].query.has_value());
  }
  EXPECT_EQ(unwatched.pairs[0].separation, 0.125);
  const trace::Frame brief = Runner(scenario, trace::Stages::none()).frame(0);
  EXPECT_EQ(brief.pairs[1].overlap, true);
  EXPECT_FALSE(brief.pairs[1].query->bounds_a.has_value());
  EXPECT_THAT(brief.pairs[1].query->axes, IsEmpty());
}

TEST(QueryKeys, ABroadPhaseChoosesPairsThatAnswer) {
  const Scenario scenario =
      parsed(kFloorAndWall +
             "[world]\nbroad_phase = \"tree\"\n[pipeline]\nquery = \"overlap\"\n"
             "[[expect]]\na = \"floor\"\nb = \"wall\"\noverlap = true\n"
             "intersections = 4\n");
  const trace::Frame frame = Runner(scenario).frame(0);
  ASSERT_EQ(frame.pairs.size(), 1u);
  EXPECT_EQ(frame.pairs[0].overlap, true);
  EXPECT_THAT(unmet_expectations(scenario, {frame}),
              ElementsAre(HasSubstr("expected 4 intersections, got " +
                                    std::to_string(frame.pairs[0].intersections.size()))));
}

TEST(QueryKeys, BoxesAllEqualOrOfEveryLengthThatIsAllowedAreChosenAlikeByAll) {
  const int count = test::cases(300);
  const std::string equal =
      "[shapes.ball]\ntype = \"sphere\"\nradius = 0.1\n"
      "scatter = { count = " +
      std::to_string(count) + ", lower = [0, 0, 0], upper = [0, 0, 0], turned = false }\n";
  const std::string extreme =
      "[shapes.grain]\ntype = \"sphere\"\nradius = 1e-9\n"
      "[shapes.world]\ntype = \"sphere\"\nradius = 1e9\n"
      "[shapes.far]\ntype = \"sphere\"\nradius = 1e-9\nposition = [1e9, 1e9, -1e9]\n";
  const auto overlapping = [](const std::string& shapes, const std::string& broad_phase) {
    const Scenario scenario =
        parsed("title = \"Bad input\"\n" + shapes + kGround +
               "[pipeline]\nquery = \"overlap\"\n[world]\nbroad_phase = \"" + broad_phase + "\"\n");
    const trace::Frame frame = Runner(scenario).frame(0);
    return std::ranges::count(frame.pairs, std::optional(true), &trace::Pair::overlap);
  };
  for (const BroadPhaseInfo& info : broad_phases()) {
    EXPECT_EQ(overlapping(equal, std::string(info.name)), count * (count - 1) / 2 + count)
        << info.name;
    // The grain and the world touch the ground, and the grain is in the world.
    EXPECT_EQ(overlapping(extreme, std::string(info.name)), 3) << info.name;
  }
}

TEST(QueryKeys, ASensorIsPassedThrough) {
  const Scenario scenario = parsed(
      "title = \"Sensor\"\n[time]\nframes = 30\n"
      "[shapes.floor]\ntype = \"box\"\nhalf_extents = [2, 0.5, 2]\nposition = [0, -0.5, 0]\n"
      "[shapes.ball]\ntype = \"sphere\"\nradius = 0.25\nposition = [0, 0.3, 0]\n"
      "motion = { dynamic = true, mass = 1, velocity = [0, -4, 0] }\n"
      "[pipeline]\nquery = \"overlap\"\n");
  Runner runner(scenario);
  EXPECT_EQ(runner.frame(0).pairs[0].overlap, false);
  EXPECT_EQ(runner.frame(5).pairs[0].overlap, true);
  EXPECT_LT(runner.frame(29).poses[1].second.position.y(), -1.5);
}

}  // namespace
}  // namespace contactscope
