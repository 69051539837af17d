#include <set>

#include "core/at.h"
#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

/// [x, y, z, separation], metres.
ContactPoint<double> read_patch_point(const Value& value) {
  if (!value.is_array() || value.array().size() != 4)
    value.fail("'" + value.name() +
               "' is a point with its separation; write [x, y, z, separation] in metres, where a "
               "negative separation is an overlap");
  const std::vector<double> numbers = value.numbers(4);
  return {{numbers[0], numbers[1], numbers[2]}, numbers[3], FeatureId()};
}

ScenarioPatch read_patch(const Value& value, std::size_t place) {
  const Value table = value.table({"patch"});
  ScenarioPatch patch;
  patch.name = "patch " + std::to_string(place + 1);
  table.read("name", patch.name, &Value::non_empty_string);
  patch.normal = read_direction(table.require("normal"));
  const Value points = table.require("points");
  patch.points = mapped(points.array(), read_patch_point);
  if (patch.points.empty())
    points.fail("'points' is empty; a patch has at least one, as [x, y, z, separation] in metres");
  if (patch.points.size() > kMaxManifoldPoints)
    points.fail("'points' has " + std::to_string(patch.points.size()) +
                " entries; a patch may have " + std::to_string(kMaxManifoldPoints));
  return patch;
}

/// Keys of [pipeline] that apply to patches; all others control how points are found.
constexpr std::string_view kPatchSettings[] = {"scalar", "reducer", "max_points"};

void warn_of_settings(const Value& pipeline, std::vector<std::string>& warnings) {
  for (const Value& setting : pipeline.members()) {
    if (std::ranges::find(kPatchSettings, setting.name()) != std::end(kPatchSettings)) continue;
    warnings.push_back("line " + std::to_string(setting.line()) + ": '" + setting.name() +
                       "' has no effect: a patch already has its points; remove it");
  }
}

}  // namespace

void read_patches(const Value& file, const Value& value, Scenario& scenario) {
  for (const char* key : {"shapes", "pairs", "time", "world", "solver", "expect"}) {
    if (const auto other = file.find(key))
      other->fail(
          std::string("'") + key +
          "' needs shapes, and a file of [[patch]] has only points; remove it, or the patches");
  }
  std::set<std::string> names;
  for (const Value& item : value.array_of_tables()) {
    scenario.patches.push_back(read_patch(item, scenario.patches.size()));
    if (!names.insert(scenario.patches.back().name).second)
      item.fail("two patches are named '" + scenario.patches.back().name +
                "'; give each its own 'name'");
  }
  if (scenario.patches.empty())
    value.fail("'patch' is empty; add a [[patch]] with its 'normal' and 'points'");
  if (!file.find("title") && scenario.patches.size() == 1)
    scenario.title = scenario.patches.front().name;
  if (const auto pipeline = file.find("pipeline")) {
    scenario.pipeline = read_pipeline(*pipeline);
    warn_of_settings(*pipeline, scenario.warnings);
  }
  scenario.scalar = scenario.pipeline.scalar;

  View plane;
  plane.kind = ViewKind::ContactPlane;
  scenario.views = {plane};
  if (const auto views = file.find("views")) {
    scenario.views = read_views(*views);
    const std::vector<Value> tables = views->array();
    for (std::size_t i = 0; i < tables.size(); ++i) {
      if (scenario.views[i].kind != ViewKind::ContactPlane)
        tables[i].fail(
            "a patch has no shapes to draw, only points in a plane; set kind = "
            "\"contact_plane\", or leave 'views' out");
    }
  }
  scenario.snapshots = read_snapshots(file.find("snapshots"), scenario.frames, scenario.views);
}

}  // namespace contactscope::scenario_file
