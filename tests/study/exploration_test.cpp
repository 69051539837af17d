#include "study/exploration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "reduce/reducer.h"
#include "trace/exploration.h"

namespace contactscope {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// A unit crate turned by 45 degrees, 5 mm deep in a floor of half its width: an octagon of
/// contact. `crate` is appended to the shape's table, `rest` to the file.
Scenario octagon(const std::string& scalar, const std::string& crate, const std::string& rest = "",
                 int frames = 4) {
  return parse_scenario("title = \"Octagon\"\n[time]\nframes = " + std::to_string(frames) +
                            "\ndt = 0.5\n[pipeline]\nscalar = \"" + scalar +
                            "\"\n[shapes.floor]\ntype = \"box\"\nhalf_extents = [0.5, 0.5, 0.5]\n"
                            "position = [0, -0.5, 0]\n"
                            "[shapes.crate]\ntype = \"box\"\nhalf_extents = [0.5, 0.5, 0.5]\n" +
                            crate + "\n" + rest,
                        "hull/octagon.toml");
}

const char* const kAtRest =
    "position = [0, 0.495, 0]\nrotation = { axis = [0, 1, 0], degrees = 45 }";

ExploreOptions untimed(std::vector<std::string> reducers = {}) {
  ExploreOptions options;
  options.reducers = std::move(reducers);
  options.measure_time = false;
  return options;
}

const trace::ReducerAnswer& answer_of(const trace::Exploration& exploration,
                                      const std::string& reducer) {
  const auto found = std::ranges::find(exploration.reducers, reducer, &trace::ReducerAnswer::name);
  if (found == exploration.reducers.end()) throw std::out_of_range(reducer);
  return *found;
}

class Explore : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scalars, Explore, testing::Values("float", "double"),
                         [](const auto& test) { return std::string(test.param); });

/// Two crates turn on a floor: two manifolds that are explored at once.
TEST_P(Explore, GivesTheSameForAnyNumberOfThreads) {
  const Scenario scenario = octagon(
      GetParam(), std::string(kAtRest) + "\nmotion = { angular_velocity = [0, 0.1, 0] }",
      "[shapes.other]\ntype = \"box\"\nhalf_extents = [0.2, 0.2, 0.2]\nposition = [0.3, 1.19, 0]\n"
      "[[pairs]]\na = \"floor\"\nb = \"crate\"\n[[pairs]]\na = \"crate\"\nb = \"other\"");
  const auto record = [&](int threads) {
    ExploreOptions options = untimed();
    options.threads = threads;
    std::map<std::string, int> steps;
    options.progress = [&](const std::string& what, int) { ++steps[what]; };
    std::string lines;
    for (const trace::Exploration& exploration : explore(scenario, 3, options))
      lines += trace::to_json_line(exploration) + "\n";
    EXPECT_EQ(steps["frames"], 4);
    EXPECT_EQ(steps["manifolds"], 2);
    return lines;
  };
  const std::string alone = record(1);
  EXPECT_EQ(std::ranges::count(alone, '\n'), 8);
  EXPECT_EQ(record(2), alone);
  EXPECT_EQ(record(5), alone);
}

TEST_P(Explore, RunsEveryListedReducerButTheOneThatKeepsAll) {
  std::vector<std::string> listed;
  for (const ReducerInfo& info : reducers()) {
    if (info.name != "none") listed.push_back(info.name);
  }
  for (const trace::Exploration& exploration :
       explore(octagon(GetParam(), kAtRest), 1, untimed())) {
    EXPECT_EQ(exploration.scenario, "hull/octagon");
    EXPECT_EQ(exploration.a, "floor");
    EXPECT_EQ(exploration.b, "crate");
    std::vector<std::string> names;
    for (const trace::ReducerAnswer& answer : exploration.reducers) names.push_back(answer.name);
    EXPECT_EQ(names, listed);
  }
}

TEST_P(Explore, KeptIndicesAreDifferentAndAmongThePoints) {
  const auto explorations = explore(octagon(GetParam(), kAtRest), 3, untimed());
  ASSERT_THAT(explorations, SizeIs(4));
  for (const trace::Exploration& exploration : explorations) {
    ASSERT_THAT(exploration.points, SizeIs(8));
    EXPECT_THAT(exploration.best, SizeIs(4));
    for (const trace::ReducerAnswer& answer : exploration.reducers) {
      const std::set<int> kept(answer.kept.begin(), answer.kept.end());
      EXPECT_EQ(kept.size(), answer.kept.size()) << answer.name;
      EXPECT_GE(kept.size(), 1u) << answer.name;
      EXPECT_LE(kept.size(), 4u) << answer.name;
      EXPECT_GE(*kept.begin(), 0) << answer.name;
      EXPECT_LT(*kept.rbegin(), 8) << answer.name;
      EXPECT_FALSE(answer.median || answer.min || answer.quarter) << answer.name;
    }
  }
}

TEST_P(Explore, OptimalKeepsTheBestAreaAndNoneIsAboveIt) {
  const auto explorations = explore(octagon(GetParam(), kAtRest), 0, untimed());
  ASSERT_THAT(explorations, SizeIs(1));
  const trace::Exploration& exploration = explorations[0];
  // A regular octagon, cut from a unit square by the other one: circumradius^2 is the square of
  // half a side over cos 22.5 degrees, and the best quadrilateral is its inscribed square.
  const double c = std::cos(std::numbers::pi / 8);
  EXPECT_NEAR(exploration.best_area, 2 * 0.25 / (c * c), 1e-5);
  EXPECT_NEAR(answer_of(exploration, "optimal").area_ratio, 1, 1e-6);
  for (const trace::ReducerAnswer& answer : exploration.reducers) {
    EXPECT_LE(answer.area_ratio, 1 + 1e-12) << answer.name;
    EXPECT_NEAR(answer.area, answer.area_ratio * exploration.best_area, 1e-12) << answer.name;
  }
}

TEST_P(Explore, AtRestNothingChangesAndNothingMoves) {
  for (const trace::Exploration& exploration :
       explore(octagon(GetParam(), kAtRest), 3, untimed())) {
    EXPECT_EQ(exploration.bodies_moved, 0);
    for (const trace::ReducerAnswer& answer : exploration.reducers) {
      EXPECT_EQ(answer.ids_changed, 0) << answer.name;
      EXPECT_EQ(answer.patch_moved, 0) << answer.name;
    }
  }
}

TEST_P(Explore, BodiesFollowTheScript) {
  const std::string sliding = std::string(kAtRest) + "\nmotion = { velocity = [0.06, 0, -0.08] }";
  const auto explorations = explore(octagon(GetParam(), sliding), 3, untimed());
  ASSERT_THAT(explorations, SizeIs(4));
  EXPECT_EQ(explorations[0].bodies_moved, 0);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(explorations[i].frame, static_cast<int>(i));
    EXPECT_NEAR(explorations[i].bodies_moved, 0.05, 1e-6);  // 0.1 m/s for half a second
  }
}

TEST_P(Explore, ATurningBodyMovesMostAtItsCorners) {
  const std::string turning =
      std::string(kAtRest) + "\nmotion = { angular_velocity = [0, 0.01, 0] }";
  const auto explorations = explore(octagon(GetParam(), turning), 1, untimed());
  ASSERT_THAT(explorations, SizeIs(2));
  // Even if the corners overhang and touch nothing.
  EXPECT_NEAR(explorations[1].bodies_moved, 2 * std::sin(0.0025) * std::sqrt(0.5), 1e-6);
}

/// A bar of two metres that leans by a milliradian on one end, then on the other, then rests: the
/// corners of its ends are 9 and 11 mm deep.
Scenario rocking_bar(const std::string& scalar) {
  return parse_scenario(
      "title = \"Bar\"\n[time]\nframes = 3\ndt = 1.0\n[pipeline]\nscalar = \"" + scalar +
          "\"\nmax_points = 2\n[shapes.floor]\ntype = \"box\"\nhalf_extents = [3, 0.5, 3]\n"
          "position = [0, -0.5, 0]\n[shapes.bar]\ntype = \"box\"\nhalf_extents = [1, 0.1, 0.25]\n"
          "[shapes.bar.motion]\nkeyframes = [\n"
          "{ time = 0, position = [0, 0.09, 0], rotation = { axis = [0, 0, 1], degrees = 0.0573 } "
          "},\n"
          "{ time = 1, position = [0, 0.09, 0], rotation = { axis = [0, 0, -1], degrees = 0.0573 } "
          "},\n"
          "{ time = 2, position = [0, 0.09, 0], rotation = { axis = [0, 0, -1], degrees = 0.0573 } "
          "} ]\n",
      "hull/bar.toml");
}

TEST_P(Explore, ReplacedPointsHaveMovedToTheOthers) {
  const auto explorations =
      explore(rocking_bar(GetParam()), 2, untimed({"deepest", "optimal_deepest"}));
  ASSERT_THAT(explorations, SizeIs(3));
  const trace::ReducerAnswer& over = answer_of(explorations[1], "deepest");
  EXPECT_EQ(over.ids_changed, 4);
  // From the left bottom corner to the right one, a decimetre below the centre.
  const double lean = 0.0573 * std::numbers::pi / 180;
  EXPECT_NEAR(over.patch_moved, 2 * std::cos(lean) - 0.2 * std::sin(lean), 1e-6);
  // Two milliradians at the corner farthest from the centre.
  const double corner = 2 * std::sin(lean) * std::hypot(1.0, 0.1);
  EXPECT_NEAR(explorations[1].bodies_moved, corner, 1e-6);
  const trace::ReducerAnswer& still = answer_of(explorations[2], "deepest");
  EXPECT_EQ(still.ids_changed, 0);
  EXPECT_EQ(still.patch_moved, 0);
  EXPECT_EQ(explorations[2].bodies_moved, 0);
  EXPECT_NEAR(summarize(explorations).back().moves.value(), 2 / corner, 1);
}

/// The range on half a side of a unit square that remains of it within another one turned about the
/// same centre: the other's sides cross the line y = 1/2 at its ends.
std::pair<double, double> cut(double turn) {
  return {(0.5 - 0.5 * std::sin(turn)) / std::cos(turn),
          (0.5 - 0.5 * std::cos(turn)) / std::sin(turn)};
}

// The centre of a square of contacts stays when the octagon's other square replaces it: a measure
// of the centre alone would miss the change.
TEST_P(Explore, ASquareReplacedByTheOtherHasMoved) {
  const std::string turning =
      "position = [0, 0.495, 0]\n[shapes.crate.motion]\nkeyframes = [\n"
      "{ time = 0.0, rotation = { axis = [0, 1, 0], degrees = 43 } },\n"
      "{ time = 0.5, rotation = { axis = [0, 1, 0], degrees = 47 } } ]\n";
  const auto explorations =
      explore(octagon(GetParam(), turning, "", 2), 1, untimed({"optimal", "coherent"}));
  ASSERT_THAT(explorations, SizeIs(2));
  const trace::ReducerAnswer& optimal = answer_of(explorations[1], "optimal");
  EXPECT_EQ(optimal.ids_changed, 8);
  // One side of the fixed square has two points: the far one is kept before, the near one after.
  const double degree = std::numbers::pi / 180;
  const auto before = cut(43 * degree), after = cut(47 * degree);
  const double distance_along =
      std::min(std::abs(before.first + after.second), std::abs(before.second + after.first));
  EXPECT_NEAR(optimal.patch_moved, distance_along, 0.03);
  EXPECT_GT(optimal.patch_moved, 0.35);
  const trace::ReducerAnswer& coherent = answer_of(explorations[1], "coherent");
  EXPECT_EQ(coherent.ids_changed, 0);
  // Each point slides along its side.
  EXPECT_LT(coherent.patch_moved, 0.05);
}

/// A tower one metre high on a base of 0.2 by 0.2, square on a ramp.
std::set<bool> tower_held(const std::string& scalar, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  const std::string turn =
      "rotation = { axis = [0, 0, 1], degrees = " + std::to_string(degrees) + " }\n";
  const auto explorations = explore(
      parse_scenario("title = \"Ramp\"\n[pipeline]\nscalar = \"" + scalar +
                         "\"\n[shapes.ramp]\ntype = \"box\"\nhalf_extents = [2, 0.5, 2]\n" + turn +
                         "[shapes.tower]\ntype = \"box\"\nhalf_extents = [0.1, 0.5, 0.1]\n" + turn +
                         "position = [" + std::to_string(-0.999 * std::sin(angle)) + ", " +
                         std::to_string(0.999 * std::cos(angle)) + ", 0]\n",
                     "hull/ramp.toml"),
      0, untimed());
  std::set<bool> verdicts;
  for (const trace::ReducerAnswer& answer : explorations.at(0).reducers)
    verdicts.insert(answer.supports_center_of_mass.value());
  return verdicts;
}

// It tips if the tangent exceeds half its base over half its height: at 11.3 degrees.
TEST_P(Explore, ATowerOnARampTipsWherePlumbBelowItsMiddleIsNoBase) {
  EXPECT_THAT(tower_held(GetParam(), 0), ElementsAre(true));
  EXPECT_THAT(tower_held(GetParam(), 11), ElementsAre(true));
  EXPECT_THAT(tower_held(GetParam(), 11.6), ElementsAre(false));
  EXPECT_THAT(tower_held(GetParam(), -30), ElementsAre(false));
}

/// A box of 0.8 by 0.8 on a flat mesh from -2 to 2 m of triangles with sides of 0.5 m.
std::vector<trace::Exploration> box_on_mesh(const std::string& scalar, const std::string& x,
                                            const std::string& manifolds = "triangle") {
  return explore(parse_scenario("title = \"Mesh\"\n[pipeline]\nscalar = \"" + scalar +
                                    "\"\nmesh_manifolds = \"" + manifolds +
                                    "\"\n[shapes.crate]\ntype = \"box\"\n"
                                    "half_extents = [0.4, 0.3, 0.4]\nposition = [" +
                                    x +
                                    ", 0.29, 0.07]\n[shapes.floor]\ntype = \"mesh\"\n"
                                    "grid = { size = [4, 4], cells = [8, 8] }\n",
                                "mesh/crate.toml"),
                 0, untimed({"none", "first", "area"}));
}

TEST_P(Explore, AMeshIsReducedAsAWhole) {
  const auto explorations = box_on_mesh(GetParam(), "0.05", "pair");
  ASSERT_EQ(explorations.size(), 1u);
  EXPECT_FALSE(explorations[0].triangle);
  EXPECT_GT(explorations[0].points.size(), 12u);
  EXPECT_NEAR(answer_of(explorations[0], "none").area, 0.8 * 0.8, 1e-5);
  EXPECT_NEAR(answer_of(explorations[0], "area").area, 0.8 * 0.8, 1e-5);
}

TEST_P(Explore, EveryTriangleOfAMeshIsReduced) {
  const auto explorations = box_on_mesh(GetParam(), "0.05");
  std::set<int> triangles;
  double covered = 0;
  for (const trace::Exploration& exploration : explorations) {
    ASSERT_TRUE(exploration.triangle);
    triangles.insert(*exploration.triangle);
    covered += answer_of(exploration, "none").area;
    // A triangle carries at most one corner of the box; the box rests on all of them.
    for (const trace::ReducerAnswer& answer : exploration.reducers)
      EXPECT_TRUE(answer.supports_center_of_mass.value()) << answer.name;
  }
  EXPECT_EQ(triangles.size(), explorations.size());
  EXPECT_GE(triangles.size(), 8u);
  EXPECT_NEAR(covered, 0.8 * 0.8, 1e-5);
  for (const trace::Exploration& exploration : box_on_mesh(GetParam(), "2.1")) {
    for (const trace::ReducerAnswer& answer : exploration.reducers)
      EXPECT_FALSE(answer.supports_center_of_mass.value()) << answer.name;
  }
}

TEST_P(Explore, EveryReducerHoldsASlabInTheMiddleAndNoneOneThatHangsOver) {
  const std::string slab = "[shapes.slab]\ntype = \"box\"\nhalf_extents = [2, 0.1, 0.4]\n";
  const std::string pairs = "[[pairs]]\na = \"floor\"\nb = \"slab\"\n";
  const auto held = [&](const std::string& position) {
    const auto explorations =
        explore(octagon(GetParam(), "position = [0, 9, 0]", slab + position + "\n" + pairs), 0,
                untimed({"area", "area_deepest", "optimal", "none"}));
    EXPECT_THAT(explorations, SizeIs(1));
    std::set<bool> verdicts;
    for (const trace::ReducerAnswer& answer : explorations.at(0).reducers) {
      verdicts.insert(answer.supports_center_of_mass.value());
    }
    return verdicts;
  };
  EXPECT_THAT(held("position = [0, 0.095, 0]"), ElementsAre(true));
  EXPECT_THAT(held("position = [0.3, 0.095, 0.1]"), ElementsAre(true));
  EXPECT_THAT(held("position = [0.6, 0.095, 0]"), ElementsAre(false));
  EXPECT_THAT(held("position = [0, 0.095, -0.8]"), ElementsAre(false));
}

TEST_P(Explore, SeparatedFramesAreLeftOutAndReset) {
  // Down, up, and down again, after a quarter turn: frames 0 and 2 touch.
  const std::string hopping =
      "rotation = { axis = [0, 1, 0], degrees = 45 }\nmotion = { keyframes = [ "
      "{ time = 0.0, position = [0, 0.495, 0] }, { time = 0.5, position = [0, 0.9, 0] }, "
      "{ time = 1.0, position = [0.05, 0.495, 0] } ] }";
  const auto explorations = explore(octagon(GetParam(), hopping), 2, untimed());
  ASSERT_THAT(explorations, SizeIs(2));
  EXPECT_EQ(explorations[0].frame, 0);
  EXPECT_EQ(explorations[1].frame, 2);
  for (const trace::ReducerAnswer& answer : explorations[1].reducers) {
    EXPECT_EQ(answer.ids_changed, 0) << answer.name;
    EXPECT_EQ(answer.patch_moved, 0) << answer.name;
  }
  EXPECT_THAT(explore(octagon(GetParam(), "position = [0, 5, 0]"), 3, untimed()), IsEmpty());
}

TEST_P(Explore, FewPointsAreKeptWholeByAll) {
  const auto explorations =
      explore(octagon(GetParam(), "position = [0.25, 0.495, 0.125]"), 0, untimed());
  ASSERT_THAT(explorations, SizeIs(1));
  EXPECT_THAT(explorations[0].points, SizeIs(4));
  EXPECT_NEAR(explorations[0].best_area, 0.75 * 0.875, 1e-6);
  for (const trace::ReducerAnswer& answer : explorations[0].reducers) {
    EXPECT_THAT(answer.kept, ElementsAre(0, 1, 2, 3)) << answer.name;
    EXPECT_EQ(answer.area_ratio, 1) << answer.name;
    EXPECT_TRUE(answer.deepest_kept) << answer.name;
  }
}

TEST_P(Explore, PairsThatDifferInTheReducerAloneAppearOnce) {
  const std::string pair = "[[pairs]]\na = \"floor\"\nb = \"crate\"\n";
  const auto explorations =
      explore(octagon(GetParam(), kAtRest,
                      pair + "label = \"one\"\n" + pair + "label = \"two\"\nreducer = \"first\"\n" +
                          pair + "label = \"three\"\nreducer = \"first\"\nmax_points = 3\n"),
              1, untimed());
  std::vector<std::pair<int, std::string>> list;
  for (const trace::Exploration& exploration : explorations) {
    list.emplace_back(exploration.frame, exploration.label);
  }
  EXPECT_THAT(list, ElementsAre(std::pair(0, "one"), std::pair(0, "three"), std::pair(1, "one"),
                                std::pair(1, "three")));
  EXPECT_THAT(answer_of(explorations.at(0), "area").kept, SizeIs(4));
  EXPECT_THAT(answer_of(explorations.at(1), "area").kept, SizeIs(3));
}

TEST_P(Explore, PairsThatDifferInAnyOtherSettingAllAppear) {
  const std::string pair = "[[pairs]]\na = \"floor\"\nb = \"crate\"\nlabel = ";
  const std::string settings[] = {"margin = 0.01",         "preference = \"none\"",
                                  "penetration = \"epa\"", "manifold = \"incremental\"",
                                  "degenerate = \"skip\"", "internal_edges = false",
                                  "cache = false"};
  std::string pairs = pair + "\"one\"\n" + pair + "\"two\"\nreducer = \"first\"\n";
  std::vector<std::string> expected = {"one"};
  for (const std::string& setting : settings) {
    expected.push_back(setting.substr(0, setting.find(' ')));
    pairs += pair + "\"" + expected.back() + "\"\n" + setting + "\n";
  }
  std::vector<std::string> labels;
  for (const trace::Exploration& exploration :
       explore(octagon(GetParam(), kAtRest, pairs), 0, untimed({"area"}))) {
    labels.push_back(exploration.label);
  }
  EXPECT_EQ(labels, expected);
  // A result that is shared by several reducers has no label.
  const auto alone = explore(octagon(GetParam(), kAtRest,
                                     pair + "\"bullet\"\nreducer = \"bullet\"\n" + pair +
                                         "\"first\"\nreducer = \"first\"\n"),
                             0, untimed({"area"}));
  ASSERT_THAT(alone, SizeIs(1));
  EXPECT_EQ(alone[0].label, "");
}

TEST_P(Explore, AnswersOnlyTheGivenReducersInOrder) {
  const auto explorations =
      explore(octagon(GetParam(), kAtRest), 0, untimed({"optimal", "none", "area"}));
  ASSERT_THAT(explorations, SizeIs(1));
  ASSERT_THAT(explorations[0].reducers, SizeIs(3));
  EXPECT_EQ(explorations[0].reducers[0].name, "optimal");
  EXPECT_EQ(explorations[0].reducers[1].name, "none");
  EXPECT_THAT(explorations[0].reducers[1].kept, SizeIs(8));
  EXPECT_EQ(explorations[0].reducers[1].area_ratio, 1);
  EXPECT_EQ(explorations[0].reducers[2].name, "area");
}

TEST(ExploreTimes, AreMeasuredWhereSomethingIsReduced) {
  ExploreOptions options;
  options.reducers = {"area", "first"};
  for (const trace::Exploration& exploration : explore(octagon("float", kAtRest), 0, options)) {
    for (const trace::ReducerAnswer& answer : exploration.reducers) {
      ASSERT_TRUE(answer.median && answer.min && answer.quarter) << answer.name;
      EXPECT_GT(*answer.min, 0) << answer.name;
      EXPECT_GE(*answer.median, *answer.min) << answer.name;
      EXPECT_GE(*answer.quarter, *answer.median) << answer.name;
    }
  }
  const auto whole = explore(octagon("float", "position = [0, 0.495, 0]"), 0, options);
  ASSERT_THAT(whole, SizeIs(1));
  EXPECT_FALSE(whole[0].reducers[0].median);
}

trace::ReducerAnswer answer(const std::string& name, double ratio, double wrench) {
  trace::ReducerAnswer result;
  result.name = name;
  result.area_ratio = ratio;
  result.wrench_error = wrench;
  return result;
}

TEST(Summarize, RowsHaveMeansExtremesSharesAndSums) {
  trace::Exploration first, second;
  first.reducers = {answer("only", 1, 0.5)};
  first.reducers[0].deepest_kept = true;
  first.reducers[0].depth_error = 0.002;
  first.reducers[0].median = 50;
  first.reducers[0].min = 40;
  second.reducers = {answer("only", 0.5, 0.25)};
  second.reducers[0].supports_center_of_mass = true;
  second.reducers[0].deepest_kept = true;
  second.reducers[0].depth_error = 0.001;
  second.reducers[0].ids_changed = 3;
  second.reducers[0].patch_moved = 0.06;
  second.reducers[0].median = 50;
  second.reducers[0].min = 30;
  second.bodies_moved = 0.02;
  const std::vector<ReducerSummary> rows = summarize({first, second});
  ASSERT_THAT(rows, SizeIs(1));
  EXPECT_EQ(rows[0].name, "only");
  EXPECT_DOUBLE_EQ(rows[0].mean_area_ratio, 0.75);
  EXPECT_EQ(rows[0].worst_area_ratio, 0.5);
  EXPECT_DOUBLE_EQ(rows[0].mean_wrench_error, 0.375);
  EXPECT_EQ(rows[0].worst_wrench_error, 0.5);
  EXPECT_EQ(rows[0].worst_depth_error, 0.002);
  EXPECT_DOUBLE_EQ(rows[0].deepest_kept, 1);
  EXPECT_DOUBLE_EQ(rows[0].supported.value(), 0.5);
  EXPECT_EQ(rows[0].ids_changed, 3);
  EXPECT_DOUBLE_EQ(rows[0].moves.value(), 3);
  EXPECT_EQ(rows[0].median, 50);
  EXPECT_EQ(rows[0].min, 30);
}

TEST(Summarize, TheLeastErrorStandsFirst) {
  trace::Exploration exploration;
  exploration.reducers = {answer("worst", 0.5, 0.1), answer("z", 0.9, 0.2), answer("a", 0.9, 0.3),
                          answer("y", 0.9, 0.2), answer("best", 1, 0.9)};
  std::vector<std::string> order;
  for (const ReducerSummary& row : summarize({exploration, exploration})) order.push_back(row.name);
  EXPECT_THAT(order, ElementsAre("best", "y", "z", "a", "worst"));
}

TEST(Summarize, MovesAreTheWorstFrameAndInfiniteOnBodiesAtRest) {
  std::vector<trace::Exploration> frames(3);
  for (trace::Exploration& frame : frames) frame.reducers = {answer("only", 1, 0)};
  frames[0].bodies_moved = 1;
  frames[1].bodies_moved = 0.25;
  frames[1].reducers[0].patch_moved = 0.5;
  EXPECT_EQ(summarize(frames).at(0).moves, 2);
  frames[2].reducers[0].patch_moved = 1e-3;
  EXPECT_EQ(summarize(frames).at(0).moves, std::numeric_limits<double>::infinity());
}

TEST(Summarize, NoInputGivesNoRowsAndAtRestNothingMoves) {
  EXPECT_THAT(summarize({}), IsEmpty());
  trace::Exploration exploration;
  exploration.reducers = {answer("only", 1, 0)};
  EXPECT_FALSE(summarize({exploration}).at(0).moves);
  EXPECT_EQ(summarize({exploration}).at(0).median, 0);
}

}  // namespace
}  // namespace contactscope
