// Claims of the pictures in scenarios/reduction that no expectation can state: how much area each
// pair keeps, whether the deepest point is kept, and how often ids change.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "scenario/run.h"
#include "scenario/scenario.h"
#include "study/exploration.h"

namespace contactscope::test {
namespace {

/// The reductions of each pair by its label, frames in order.
std::map<std::string, std::vector<trace::Reduction>> reductions(const std::string& idea) {
  const Scenario scenario =
      load_scenario(CONTACTSCOPE_SOURCE_DIR "/scenarios/reduction/" + idea + ".toml");
  Runner runner(scenario);
  std::map<std::string, std::vector<trace::Reduction>> result;
  for (int number = 0; number < scenario.frames; ++number) {
    for (const trace::Pair& pair : runner.frame(number).pairs) {
      if (pair.reduction) result[pair.label].push_back(*pair.reduction);
    }
  }
  return result;
}

double share(const trace::Reduction& reduction) { return reduction.area / reduction.best_area; }

bool keeps_deepest(const trace::Reduction& reduction) {
  const auto separation = [&](int i) {
    return reduction.points[static_cast<std::size_t>(i)].separation;
  };
  const double deepest =
      std::ranges::min(reduction.points, {}, &trace::Point::separation).separation;
  return std::ranges::any_of(reduction.kept, [&](int i) { return separation(i) == deepest; });
}

std::set<std::string> kept_ids(const trace::Reduction& reduction) {
  std::set<std::string> ids;
  for (const int i : reduction.kept) ids.insert(reduction.points[static_cast<std::size_t>(i)].id);
  return ids;
}

/// Number of ids that appear or vanish from frame to frame.
std::size_t changed_ids(const std::vector<trace::Reduction>& frames) {
  std::size_t changed = 0;
  for (std::size_t f = 1; f < frames.size(); ++f) {
    std::vector<std::string> difference;
    std::ranges::set_symmetric_difference(kept_ids(frames[f - 1]), kept_ids(frames[f]),
                                          std::back_inserter(difference));
    changed += difference.size();
  }
  return changed;
}

TEST(ReductionScenarios, GoodAndBadPointsDifferInArea) {
  const auto all = reductions("good_and_bad_points");
  EXPECT_GT(share(all.at("area: the talk's steps").at(0)), 0.999);
  EXPECT_NEAR(share(all.at("first: in the order of clipping").at(0)), 0.32, 0.01);
}

TEST(ReductionScenarios, DistanceLosesAreaThatAreaKeeps) {
  const auto all = reductions("area_not_distance");
  EXPECT_GT(share(all.at("largest area: area").at(0)), 0.95);
  EXPECT_LT(share(all.at("farthest from an edge: distance").at(0)), 0.8);
}

TEST(ReductionScenarios, ExtremesLoseTheAreaAtHalfAQuarterTurnOnly) {
  const auto all = reductions("aabb_pitfall");
  const std::vector<trace::Reduction>& extremes = all.at("extremes along x and z");
  EXPECT_LT(share(extremes.at(9)), 0.3);
  EXPECT_GT(share(extremes.at(0)), 0.9);
  EXPECT_GT(share(extremes.at(18)), 0.9);
  for (const trace::Reduction& reduction : all.at("area")) EXPECT_GT(share(reduction), 0.94);
}

TEST(ReductionScenarios, EightToFourGivesEightPointsToSixReducers) {
  const auto all = reductions("eight_to_four");
  EXPECT_EQ(all.size(), 6u);
  for (const auto& [label, frames] : all) {
    EXPECT_EQ(frames.at(0).points.size(), 8u) << label;
    EXPECT_LE(share(frames.at(0)), 1 + 1e-6) << label;
  }
  EXPECT_GT(share(all.at("the largest area").at(0)), 1 - 1e-6);
  EXPECT_FALSE(keeps_deepest(all.at("the largest area").at(0)));
  EXPECT_TRUE(keeps_deepest(all.at("optimal deepest").at(0)));
}

TEST(ReductionScenarios, HiddenDeepestIsLostByTheStepsAndKeptByRequest) {
  const auto all = reductions("hidden_deepest");
  EXPECT_FALSE(keeps_deepest(all.at("area").at(0)));
  EXPECT_TRUE(keeps_deepest(all.at("area deepest").at(0)));
  EXPECT_GT(share(all.at("area deepest").at(0)), 0.97);
}

TEST(ReductionScenarios, TheFourDeepestJumpAndTheLargestStay) {
  const auto all = reductions("depth_crossing");
  // All four change, there and back.
  EXPECT_EQ(changed_ids(all.at("the four deepest")), 16u);
  EXPECT_EQ(changed_ids(all.at("area")), 0u);
  for (const trace::Reduction& reduction : all.at("the four deepest"))
    EXPECT_LT(share(reduction), 0.34);
  for (const trace::Reduction& reduction : all.at("area")) EXPECT_GT(share(reduction), 0.999);
}

TEST(ReductionScenarios, TheRotatingStackFlickersExceptWhereIdsAreHeld) {
  const auto all = reductions("rotating_stack");
  ASSERT_EQ(all.size(), 3u);
  // Four crossings; each swaps four points for four others.
  EXPECT_EQ(changed_ids(all.at("area")), 32u);
  EXPECT_EQ(changed_ids(all.at("bullet")), 24u);
  EXPECT_EQ(changed_ids(all.at("coherent")), 0u);
  for (const trace::Reduction& reduction : all.at("coherent")) {
    EXPECT_GT(share(reduction), 0.95);
  }
}

// Explore runs the reducers itself, the pipeline as the scenario says: both find the same flicker.
TEST(ReductionScenarios, ExploreCountsTheIdsThatThePipelineChanges) {
  const auto all = reductions("rotating_stack");
  ExploreOptions options;
  options.measure_time = false;
  for (const auto& [label, frames] : all) options.reducers.push_back(label);
  const Scenario scenario =
      load_scenario(CONTACTSCOPE_SOURCE_DIR "/scenarios/reduction/rotating_stack.toml");
  for (const ReducerSummary& row : summarize(explore(scenario, scenario.frames - 1, options))) {
    EXPECT_EQ(row.ids_changed, static_cast<int>(changed_ids(all.at(row.name)))) << row.name;
    // When one square replaces the other, the points move by about a side of the octagon, 0.41 m;
    // the box turns by less than a degree a frame.
    EXPECT_EQ(row.moves.value() > 10, row.name != "coherent") << row.name;
  }
}

/// The smallest share of the moments about the middle of all points that the kept ones resist: by
/// brute force over directions. The patch is level to half a degree.
double least_moment(const trace::Reduction& reduction) {
  Vec3d middle = Vec3d::Zero();
  for (const trace::Point& point : reduction.points)
    middle += point.position / static_cast<double>(reduction.points.size());
  double least = 1;
  for (int k = 0; k < 3600; ++k) {
    const double angle = k * 3.14159265358979 / 1800;
    const Vec3d toward(std::cos(angle), 0, std::sin(angle));
    double all = 0, kept = -1;
    for (const trace::Point& point : reduction.points)
      all = std::max(all, toward.dot(point.position - middle));
    for (const int i : reduction.kept) {
      const trace::Point& point = reduction.points[static_cast<std::size_t>(i)];
      kept = std::max(kept, toward.dot(point.position - middle));
    }
    least = std::min(least, kept / all);
  }
  return least;
}

TEST(ReductionScenarios, LargeAreaCanLoseMostOfAMoment) {
  const auto all = reductions("moment_rose");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_NEAR(least_moment(all.at("area: the talk's steps").at(0)), 0.69, 0.005);
  EXPECT_NEAR(least_moment(all.at("bullet").at(0)), 0.42, 0.005);
  EXPECT_NEAR(least_moment(all.at("physx cluster").at(0)), 0.03, 0.005);
  EXPECT_NEAR(share(all.at("bullet").at(0)), 0.88, 0.005);
}

// In each step of the talk, the chosen point wins by the measures that are shown.
TEST(ReductionScenarios, TheStagesShowWhyEachPointWasChosen) {
  for (const auto& [idea, step] : {std::pair{"first_point", 0u},
                                   {"second_point", 1u},
                                   {"third_point", 2u},
                                   {"fourth_point", 3u}}) {
    const trace::Reduction reduction = reductions(idea).at("").at(0);
    ASSERT_EQ(reduction.kept.size(), 4u);
    ASSERT_GT(reduction.choices.size(), step) << idea;
    const trace::Choice& choice = reduction.choices[step];
    const int chosen = reduction.kept[step];
    if (step == 0) {
      const auto along = [&](const trace::Point& point) {
        return choice.direction.dot(point.position);
      };
      const double most = along(*std::ranges::max_element(reduction.points, {}, along));
      EXPECT_EQ(along(reduction.points[static_cast<std::size_t>(chosen)]), most);
      continue;
    }
    // Signed areas of the fourth step are negative outside; in the third, both sides count.
    const auto worth = [step = step](const trace::Measure& measure) {
      return step == 2 ? std::abs(measure.value) : step == 3 ? -measure.value : measure.value;
    };
    const auto best = std::ranges::max_element(choice.measures, {}, worth);
    ASSERT_NE(best, choice.measures.end()) << idea;
    EXPECT_EQ(best->point, chosen) << idea;
  }
}

}  // namespace
}  // namespace contactscope::test
