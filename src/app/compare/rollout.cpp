#include "app/compare/rollout.h"

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/check/lint.h"
#include "app/cli/catalogue.h"
#include "app/cli/progress.h"
#include "app/cli/table.h"
#include "app/cli/trace_file.h"
#include "app/compare/engine_runs.h"
#include "app/compare/rollout_picture.h"
#include "app/compare/rollout_request.h"
#include "app/render/renderer.h"
#include "core/at.h"
#include "core/input_error.h"
#include "scenario/run.h"
#include "versus/rollout.h"

namespace contactscope::app {
namespace {

using versus::EngineRun;
using versus::RolloutScore;
using Json = nlohmann::ordered_json;

constexpr int kMaxFindings = 2;  // per engine, in the table and below it; JSON has all

/// This program's solver with the scenario's settings.
EngineRun own_rollout(const Scenario& scenario) {
  EngineRun own{kOwn, kOwn, CONTACTSCOPE_VERSION, "", "", {}};
  Runner runner(scenario, trace::Stages::none());
  own.trace.header = runner.header();
  for (int frame = 0; frame < scenario.frames; ++frame) {
    stop_if_interrupted();
    own.trace.frames.push_back(runner.frame(frame));
    // Other queries than contacts claim none.
    std::erase_if(own.trace.frames.back().pairs,
                  [](const trace::Pair& pair) { return pair.query.has_value(); });
  }
  return own;
}

Rollout rollout_of(const Scenario& scenario, const std::vector<std::string>& engines,
                   const std::map<std::string, std::string>& programs, double time_limit) {
  Rollout rollout{scenario.name, rollout_request(scenario)};
  for (const std::string& name : engines) {
    stop_if_interrupted();
    rollout.engine_runs.push_back(
        programs.contains(name)
            ? run_engine(name, programs.at(name), "rollout", rollout.request, time_limit)
            : own_rollout(scenario));
    rollout.scores.push_back(versus::judge_rollout(rollout.request, rollout.engine_runs.back()));
  }
  return rollout;
}

/// The most frequent causes.
std::string causes_of(const RolloutScore& score) {
  std::string causes;
  for (int i = 0; i < std::min(kMaxFindings, count_of(score.findings)); ++i)
    causes += (i == 0 ? "" : ",") + at(score.findings, i).cause;
  const int left = count_of(score.findings) - kMaxFindings;
  return causes.empty() ? "-" : left > 0 ? causes + ",+" + std::to_string(left) : causes;
}

Table table_of(const Rollout& rollout) {
  Table table = {{"engine", "frames", "rest", "fell", "at s", "drift mm", "deepest mm", "passed",
                  "gained J", "points", "lint"}};
  for (const RolloutScore& score : rollout.scores) {
    if (!score.refusal.empty()) {
      table.push_back({score.name, "no rollout", "-", "-", "-", "-", "-", "-", "-", "-", "-"});
      continue;
    }
    const bool rests = score.resting > 0 && !score.time.empty();
    table.push_back({score.name, std::to_string(score.time.size()), std::to_string(score.resting),
                     rests ? std::to_string(score.fallen) : "-",
                     score.fell_at ? spelled("%.2f", *score.fell_at) : "-",
                     rests ? millimetres(score.worst_drift) : "-",
                     score.time.empty() ? "-" : millimetres(score.worst_penetration),
                     score.time.empty() ? "-" : std::to_string(score.passed),
                     score.time.empty() ? "-" : spelled("%.3g", score.energy_gained),
                     score.time.empty() ? "-" : spelled("%.1f", score.points), causes_of(score)});
  }
  return table;
}

Json json_of(const RolloutScore& score, const EngineRun& engine_run) {
  Json json{{"name", score.name}};
  if (!engine_run.engine.empty()) json["engine"] = engine_run.engine;
  if (!engine_run.version.empty()) json["version"] = engine_run.version;
  if (!score.refusal.empty()) {
    json["no_rollout"] = score.refusal;
    return json;
  }
  if (!score.failure.empty()) json["failure"] = score.failure;
  if (!engine_run.notes.empty()) json["said"] = engine_run.notes;
  json["frames"] = score.time.size();
  json["resting"] = score.resting;
  json["fallen"] = score.fallen;
  if (score.fell_at) json["fell"] = {{"time", *score.fell_at}, {"shape", score.first_fallen}};
  if (score.resting > 0) json["drift"] = {{"worst", score.worst_drift}, {"shape", score.drifted}};
  json["penetration"] = {{"worst", score.worst_penetration}, {"where", score.worst_place}};
  json["passed"] = {{"count", score.passed}};
  if (score.passed > 0) json["passed"]["first"] = score.first_passed;
  if (!score.unknown.empty()) json["penetration"]["unknown"] = score.unknown;
  json["energy_gained"] = score.energy_gained;
  json["velocities"] = score.has_velocities ? "told" : "differences";
  json["points"] = score.points;
  json["series"] = {{"time", score.time},
                    {"height", score.height},
                    {"energy", score.energy},
                    {"penetration", score.penetration},
                    {"drift", score.drift}};
  json["findings"] = Json::array();
  for (const lint::Finding& finding : score.findings) json["findings"].push_back(to_json(finding));
  return json;
}

/// Details that do not fit into the table.
void print_notes(const Rollout& rollout, std::ostream& out) {
  for (std::size_t i = 0; i < rollout.scores.size(); ++i) {
    const RolloutScore& score = rollout.scores[i];
    if (!score.refusal.empty()) {
      out << score.name << ": " << score.refusal << '\n';
      continue;
    }
    print_words(rollout.engine_runs[i], out);
    if (!score.failure.empty()) out << score.name << ": " << score.failure << '\n';
    if (score.fell_at)
      out << score.name << ": '" << score.first_fallen << "' is the first to fall, at "
          << spelled("%.2f", *score.fell_at) << " s\n";
    if (score.worst_penetration > 0)
      out << score.name << ": deepest in " << score.worst_place << '\n';
    if (score.passed > 0)
      out << score.name << ": the first to pass through another in " << score.first_passed << '\n';
    if (!score.unknown.empty())
      out << score.name << ": the depth of " << score.unknown << " is not known, of two meshes\n";
    if (!score.has_velocities && !score.time.empty())
      out << score.name
          << ": reports no velocities; its energy is computed from the differences of poses\n";
    for (int k = 0; k < std::min(kMaxFindings, count_of(score.findings)); ++k)
      out << record(score.name, at(score.findings, k)) << '\n';
  }
}

/// True if all engines finished and agree on whether bodies stand or are stopped.
bool agree(const Rollout& rollout) {
  int standing = 0, falling = 0;
  for (const RolloutScore& score : rollout.scores) {
    if (!score.failure.empty()) return false;
    if (!score.refusal.empty()) continue;
    ++(score.fallen > 0 || score.passed > 0 ? falling : standing);
  }
  return standing == 0 || falling == 0;
}

/// Only scenarios: a trace records one result and cannot be stepped.
std::vector<Scenario> scenarios_of(const Options& options) {
  for (const std::string& argument : options.scenarios)
    if (is_trace_file(argument))
      throw UsageError("--rollout steps scenarios, but " + argument +
                       " is a trace; name a scenario, or leave out --rollout");
  return load_scenarios(options);
}

void write_picture(const Rollout& rollout, const Options& options, Renderer& renderer) {
  const std::vector<int> shown = options.selected(rollout.request.header.frames);
  const std::filesystem::path path =
      std::filesystem::path(options.out) / "versus" / rollout.name / "rollout.png";
  std::filesystem::create_directories(path.parent_path());
  write_png(path.string(), rollout_picture(rollout, shown.back(), options.size, renderer));
  if (!options.quiet) std::cerr << "a picture in " << path.string() << '\n';
}

}  // namespace

ExitCode run_rollout(const Options& options, const std::vector<std::string>& engines,
                     const std::map<std::string, std::string>& programs) {
  const std::vector<Scenario> scenarios = scenarios_of(options);
  Json json{{"schema", "contactscope.versus/1"}, {"matches", Json::array()}};
  bool all_agree = true;
  RunLog log;
  std::optional<Renderer> renderer;
  if (!options.tables_only) renderer.emplace(options.backend, log);
  for (const Scenario& scenario : scenarios) {
    const Rollout rollout = rollout_of(scenario, engines, programs, options.time_limit);
    all_agree = all_agree && agree(rollout);
    Json one{{"scenario", rollout.name}, {"rollout", true}, {"engines", Json::array()}};
    for (std::size_t i = 0; i < rollout.scores.size(); ++i)
      one["engines"].push_back(json_of(rollout.scores[i], rollout.engine_runs[i]));
    json["matches"].push_back(one);
    if (!options.json) {
      std::cout << rollout.name << '\n';
      print(table_of(rollout), std::cout);
      print_notes(rollout, std::cout);
    }
    if (renderer) write_picture(rollout, options, *renderer);
  }
  if (options.json) std::cout << json.dump() << '\n';
  return all_agree ? ExitCode::Same : ExitCode::Different;
}

}  // namespace contactscope::app
