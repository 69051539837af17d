#include "trace/exploration.h"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace contactscope::trace {
namespace {

using nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;

Exploration sample() {
  Exploration exploration;
  exploration.scenario = "hull/a";
  exploration.frame = 3;
  exploration.a = "crate";
  exploration.b = "floor";
  exploration.points = {{{0.1, 0, -0.0}, -0.005, "a:e3 b:e7"}, {{1, 0, 1e-300}, 0, "a:e1 a:e2"}};
  exploration.normal = {0, -1, 0};
  exploration.best_area = 0.125;
  exploration.best = {1, 0};
  exploration.bodies_moved = 0.25;
  ReducerAnswer area;
  area.name = "area";
  area.kept = {1};
  area.area = 0.0625;
  area.area_ratio = 0.5;
  area.deepest_kept = true;
  area.wrench_error = 0.75;
  area.depth_error = 0.001;
  area.ids_changed = 2;
  area.patch_moved = 0.03125;
  exploration.reducers = {area};
  area.name = "first";
  exploration.reducers.push_back(area);
  return exploration;
}

std::vector<std::string> keys(const ordered_json& json) {
  std::vector<std::string> names;
  for (const auto& [key, value] : json.items()) names.push_back(key);
  return names;
}

ordered_json parsed(const Exploration& exploration) {
  return ordered_json::parse(to_json_line(exploration));
}

TEST(ExplorationJson, HasTheKeysOfTheFormatInItsOrder) {
  const ordered_json line = parsed(sample());
  EXPECT_THAT(keys(line), ElementsAre("schema", "scenario", "frame", "a", "b", "points", "normal",
                                      "best_area", "best", "bodies_moved", "reducers"));
  EXPECT_EQ(line["schema"], "contactscope.explore/1");
  EXPECT_THAT(keys(line["points"][0]), ElementsAre("position", "separation", "id"));
  EXPECT_THAT(
      keys(line["reducers"][0]),
      ElementsAre("name", "kept", "area", "area_ratio", "deepest_kept", "supports_center_of_mass",
                  "wrench_error", "depth_error", "ids_changed", "patch_moved"));
}

TEST(ExplorationJson, HoldsTheValues) {
  const ordered_json line = parsed(sample());
  EXPECT_EQ(line["scenario"], "hull/a");
  EXPECT_EQ(line["frame"], 3);
  EXPECT_EQ(line["a"], "crate");
  EXPECT_EQ(line["b"], "floor");
  EXPECT_EQ(line["points"][0]["id"], "a:e3 b:e7");
  EXPECT_EQ(line["points"][0]["separation"], -0.005);
  EXPECT_EQ(line["points"][1]["position"], ordered_json({1.0, 0.0, 1e-300}));
  EXPECT_EQ(line["normal"], ordered_json({0.0, -1.0, 0.0}));
  EXPECT_EQ(line["best_area"], 0.125);
  EXPECT_EQ(line["best"], ordered_json({1, 0}));
  EXPECT_EQ(line["bodies_moved"], 0.25);
  ASSERT_EQ(line["reducers"].size(), 2u);
  const ordered_json& area = line["reducers"][0];
  EXPECT_EQ(area["name"], "area");
  EXPECT_EQ(area["kept"], ordered_json::array({1}));
  EXPECT_EQ(area["area"], 0.0625);
  EXPECT_EQ(area["area_ratio"], 0.5);
  EXPECT_EQ(area["deepest_kept"], true);
  EXPECT_EQ(area["supports_center_of_mass"], false);
  EXPECT_EQ(area["wrench_error"], 0.75);
  EXPECT_EQ(area["depth_error"], 0.001);
  EXPECT_EQ(area["ids_changed"], 2);
  EXPECT_EQ(area["patch_moved"], 0.03125);
  EXPECT_EQ(line["reducers"][1]["name"], "first");
}

TEST(ExplorationJson, HasALabelOnlyWhereOneIsSet) {
  Exploration exploration = sample();
  EXPECT_FALSE(parsed(exploration).contains("label"));
  exploration.label = "from \"above\"\n";
  const ordered_json line = parsed(exploration);
  EXPECT_EQ(line["label"], "from \"above\"\n");
  EXPECT_THAT(keys(line), testing::IsSupersetOf({"a", "b", "label"}));
  EXPECT_EQ(keys(line)[5], "label");
  EXPECT_EQ(to_json_line(exploration).find('\n'), std::string::npos);
  exploration.triangle = 12;
  EXPECT_EQ(keys(parsed(exploration))[6], "triangle");
  EXPECT_EQ(parsed(exploration)["triangle"], 12);
}

TEST(ExplorationJson, HasNanosecondsOnlyWhereMeasured) {
  Exploration exploration = sample();
  exploration.reducers[1].median = 80;
  exploration.reducers[1].min = 75.5;
  exploration.reducers[1].quarter = 90;
  const ordered_json line = parsed(exploration);
  EXPECT_FALSE(line["reducers"][0].contains("nanoseconds"));
  const ordered_json& times = line["reducers"][1]["nanoseconds"];
  EXPECT_THAT(keys(times), ElementsAre("median", "min", "upper_quartile"));
  EXPECT_EQ(times["median"], 80);
  EXPECT_EQ(times["min"], 75.5);
  EXPECT_EQ(times["upper_quartile"], 90);
}

/// The error that rejects a number which is not finite.
template <class Spoil> std::string refused(Spoil&& spoil) {
  Exploration exploration = sample();
  spoil(exploration);
  try {
    to_json_line(exploration);
  } catch (const std::domain_error& error) {
    return error.what();
  }
  return "written";
}

TEST(ExplorationJson, NonFiniteIsNotWritten) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refused([&](Exploration& e) { e.points[0].position.y() = nan; }),
              HasSubstr("'position'"));
  EXPECT_THAT(refused([&](Exploration& e) { e.points[1].separation = -infinity; }),
              HasSubstr("'separation'"));
  EXPECT_THAT(refused([&](Exploration& e) { e.normal.x() = nan; }), HasSubstr("'normal'"));
  EXPECT_THAT(refused([&](Exploration& e) { e.best_area = infinity; }), HasSubstr("'best_area'"));
  EXPECT_THAT(refused([&](Exploration& e) { e.bodies_moved = nan; }), HasSubstr("'bodies_moved'"));
  EXPECT_THAT(refused([&](Exploration& e) { e.reducers[1].area = nan; }), HasSubstr("'area'"));
  EXPECT_THAT(refused([&](Exploration& e) { e.reducers[1].area_ratio = nan; }),
              HasSubstr("'area_ratio'"));
  EXPECT_THAT(refused([&](Exploration& e) { e.reducers[0].wrench_error = infinity; }),
              HasSubstr("'wrench_error'"));
  EXPECT_THAT(refused([&](Exploration& e) { e.reducers[0].depth_error = nan; }),
              HasSubstr("'depth_error'"));
  EXPECT_THAT(refused([&](Exploration& e) { e.reducers[0].patch_moved = nan; }),
              HasSubstr("'patch_moved'"));
  EXPECT_THAT(refused([&](Exploration& e) { e.reducers[0].median = infinity; }),
              HasSubstr("'median'"));
  EXPECT_THAT(refused([&](Exploration& e) {
                e.reducers[0].median = 1;
                e.reducers[0].quarter = nan;
              }),
              HasSubstr("'upper_quartile'"));
}

}  // namespace
}  // namespace contactscope::trace
