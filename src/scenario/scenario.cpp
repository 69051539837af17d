#include "scenario/scenario.h"

#include <filesystem>

#include "core/at.h"
#include "scenario/readers.h"

namespace contactscope {
namespace {

namespace fs = std::filesystem;
using scenario_file::Value;

constexpr int kMaxFrames = 100000;
constexpr double kLongestStep = 1e6;  // seconds

/// "<group>/<idea>": the file and the folder that it is in.
std::string name_of(const std::string& path) {
  std::error_code error;
  fs::path whole = fs::absolute(path, error);
  if (error) whole = path;
  whole = whole.lexically_normal();
  const std::string group = whole.parent_path().filename().string();
  const std::string idea = whole.stem().string();
  return group.empty() ? idea : group + "/" + idea;
}

double read_step(const Value& value) {
  const double dt = value.positive("seconds");
  if (dt > kLongestStep) value.fail("'dt' is longer than 1e6 seconds; lower it");
  return dt;
}

}  // namespace

Scenario parse_scenario(const std::string& text, const std::string& path) {
  using namespace scenario_file;
  check_scenario_text(text, path);
  const toml::table document = parse_document(text, path);
  const Value file = Value(path, document, "")
                         .table({"title", "source", "tags", "up", "time", "shapes", "pairs",
                                 "pipeline", "world", "solver", "views", "expect", "snapshots"});

  Scenario scenario;
  scenario.name = name_of(path);
  scenario.path = path;
  scenario.title = file.require("title", "title = \"What the scene shows\"").non_empty_string();
  file.read("source", scenario.source, &Value::string);
  file.read("tags", scenario.tags,
            [](const Value& tags) { return mapped(tags.array(), &Value::non_empty_string); });
  file.read("up", scenario.up, [](const Value& up) { return up.one_of({"y", "z"}, "up axis"); });
  if (const auto time = file.find("time")) {
    time->table({"frames", "dt"});
    time->read("frames", scenario.frames, integer_in(1, kMaxFrames));
    time->read("dt", scenario.dt, read_step);
  }

  const Value shapes = file.require("shapes", "a shape as [shapes.NAME]");
  scenario.shapes = read_shapes(shapes, {fs::path(path).parent_path(), scenario.warnings},
                                (scenario.frames - 1) * scenario.dt);
  PipelineSettings settings;
  file.read("pipeline", settings, read_pipeline);
  const auto pairs = file.find("pairs"), world = file.find("world");
  scenario.broad_phase = read_broad_phase(world, pairs);
  scenario.pairs =
      pairs ? read_pairs(*pairs, scenario.shapes, settings)
            : every_pair(scenario.shapes, settings, !scenario.broad_phase.empty(), shapes);
  scenario.scalar = settings.scalar;
  leave_out_uncollided(scenario);
  scenario.world = read_world(world, scenario.up);
  scenario.solver = read_solver(file.find("solver"), scenario.shapes);
  warn_of_idle_keys(file, scenario);
  scenario.views = {default_view()};
  file.read("views", scenario.views, read_views);
  if (const auto expect = file.find("expect"))
    scenario.expectations = read_expectations(*expect, scenario);
  scenario.snapshots = read_snapshots(file.find("snapshots"), scenario.frames);
  return scenario;
}

Scenario load_scenario(const std::string& path) {
  return parse_scenario(scenario_file::read_scenario_text(path), path);
}

}  // namespace contactscope
