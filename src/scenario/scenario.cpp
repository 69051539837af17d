#include "scenario/scenario.h"

#include <filesystem>

#include "scenario/dynamics_keys.h"
#include "scenario/expectations.h"
#include "scenario/idle_keys.h"
#include "scenario/pairs.h"
#include "scenario/shapes.h"
#include "scenario/text_checks.h"
#include "scenario/toml_reader.h"
#include "scenario/views.h"

namespace contactscope {
namespace {

namespace fs = std::filesystem;
using toml_reader::Table;
using toml_reader::Value;

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

void read_time(const Value& value, Scenario& scenario) {
  const Table table = value.table({"frames", "dt"});
  if (const auto frames = table.find("frames")) scenario.frames = frames->integer(1, kMaxFrames);
  if (const auto dt = table.find("dt")) {
    scenario.dt = dt->positive("seconds");
    if (scenario.dt > kLongestStep) dt->fail("'dt' is longer than 1e6 seconds; lower it");
  }
}

std::vector<std::string> read_tags(const Value& value) {
  std::vector<std::string> tags;
  for (const Value& item : value.array()) tags.push_back(item.non_empty_string());
  return tags;
}

}  // namespace

Scenario parse_scenario(const std::string& text, const std::string& path) {
  using namespace scenario_file;
  check_scenario_text(text, path);
  const toml::table document = toml_reader::parse_document(text, path);
  const Table file(path, document, "",
                   {"title", "source", "tags", "up", "time", "shapes", "pairs", "pipeline", "world",
                    "solver", "views", "expect", "snapshots"});

  Scenario scenario;
  scenario.name = name_of(path);
  scenario.path = path;
  scenario.title = file.require("title", "title = \"What the scene shows\"").non_empty_string();
  file.read("source", scenario.source, &Value::string);
  file.read("tags", scenario.tags, read_tags);
  file.read("up", scenario.up, [](const Value& up) { return up.one_of({"y", "z"}, "up axis"); });
  if (const auto time = file.find("time")) read_time(*time, scenario);

  const Value shapes = file.require("shapes", "a shape as [shapes.NAME]");
  scenario.shapes = read_shapes(shapes, {fs::path(path).parent_path(), scenario.warnings},
                                (scenario.frames - 1) * scenario.dt);
  PipelineSettings settings;
  file.read("pipeline", settings, read_pipeline);
  if (const auto pairs = file.find("pairs"))
    scenario.pairs = read_pairs(*pairs, scenario.shapes, settings);
  else
    scenario.pairs = every_pair(scenario.shapes, settings, shapes);
  scenario.scalar = settings.scalar;
  for (std::string& warning : leave_out_uncollided(scenario.pairs, scenario.shapes))
    scenario.warnings.push_back(std::move(warning));

  scenario.world = default_world(scenario.up);
  if (const auto world = file.find("world")) scenario.world = read_world(*world, scenario.up);
  scenario.solver = read_solver(file.find("solver"), scenario.shapes);
  for (std::string& warning : idle_keys(file, scenario))
    scenario.warnings.push_back(std::move(warning));
  scenario.views = {default_view()};
  file.read("views", scenario.views, read_views);
  if (const auto expect = file.find("expect"))
    scenario.expectations = read_expectations(*expect, scenario);
  scenario.snapshots = default_snapshots(scenario.frames);
  if (const auto snapshots = file.find("snapshots"))
    scenario.snapshots = read_snapshots(*snapshots, scenario.frames);
  return scenario;
}

Scenario load_scenario(const std::string& path) {
  return parse_scenario(read_scenario_text(path), path);
}

}  // namespace contactscope
