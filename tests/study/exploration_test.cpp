#include "study/exploration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "reduce/reducer.h"

namespace contactscope {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// A unit crate turned by 45 degrees, 5 mm deep in a floor of half its width: an octagon of contact.
/// `crate` and `rest` go into the shape's table and to the end.
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
  // Of a regular octagon, cut from a unit square by the other: circumradius^2 is the square of half
  // a side over cos 22.5 degrees, and the best quadrilateral its inscribed square.
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

TEST_P(Explore, BodiesMoveAsTheScriptSays) {
  const std::string sliding = std::string(kAtRest) + "\nmotion = { velocity = [0.06, 0, -0.08] }";
  const auto explorations = explore(octagon(GetParam(), sliding), 3, untimed());
  ASSERT_THAT(explorations, SizeIs(4));
  EXPECT_EQ(explorations[0].bodies_moved, 0);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(explorations[i].frame, static_cast<int>(i));
    EXPECT_NEAR(explorations[i].bodies_moved, 0.05, 1e-6);  // 0.1 m/s for half a second
  }
}

TEST_P(Explore, ATurningBodyMovesMostAtItsOutermostPoint) {
  const std::string turning =
      std::string(kAtRest) + "\nmotion = { angular_velocity = [0, 0.01, 0] }";
  const auto explorations = explore(octagon(GetParam(), turning), 1, untimed());
  ASSERT_THAT(explorations, SizeIs(2));
  double reach = 0;
  for (const trace::Point& point : explorations[1].points) {
    reach = std::max(reach, std::hypot(point.position.x(), point.position.z()));
  }
  EXPECT_GT(reach, 0.5);
  EXPECT_NEAR(explorations[1].bodies_moved, 2 * std::sin(0.0025) * reach, 1e-6);
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
      verdicts.insert(answer.supports_center_of_mass);
    }
    return verdicts;
  };
  EXPECT_THAT(held("position = [0, 0.095, 0]"), ElementsAre(true));
  EXPECT_THAT(held("position = [0.3, 0.095, 0.1]"), ElementsAre(true));
  EXPECT_THAT(held("position = [0.6, 0.095, 0]"), ElementsAre(false));
  EXPECT_THAT(held("position = [0, 0.095, -0.8]"), ElementsAre(false));
}

TEST_P(Explore, WhatNothingTouchesIsLeftOutAndForgotten) {
  // Down, up, and down again, a quarter turn on: frames 0 and 2 touch.
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

TEST_P(Explore, AnswersOnlyTheReducersAskedForInThatOrder) {
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
  EXPECT_DOUBLE_EQ(rows[0].supported, 0.5);
  EXPECT_EQ(rows[0].ids_changed, 3);
  EXPECT_DOUBLE_EQ(rows[0].moves, 3);
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

TEST(Summarize, OfNothingThereAreNoRowsAndAtRestNothingMoves) {
  EXPECT_THAT(summarize({}), IsEmpty());
  trace::Exploration exploration;
  exploration.reducers = {answer("only", 1, 0)};
  EXPECT_EQ(summarize({exploration}).at(0).moves, 0);
  EXPECT_EQ(summarize({exploration}).at(0).median, 0);
}

}  // namespace
}  // namespace contactscope
