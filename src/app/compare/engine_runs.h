#pragma once

#include <nlohmann/json.hpp>

#include "app/cli/verbs.h"
#include "scenario/scenario.h"
#include "versus/rollout.h"

/// Engines of `versus` and the results of their programs.
namespace contactscope::app {

inline constexpr const char* kOwn = "contactscope";  // this program as an engine

/// Engines of --engines; by default all that are found, this program first.
std::vector<std::string> requested_engines(const Options& options);

/// Path of each engine's program by name; this program has none. Throws UsageError with the
/// available names if one is not found.
std::map<std::string, std::string> programs_of(const std::vector<std::string>& engines);

/// Runs a program with `question`, "contacts" or "rollout". If it crashes, exceeds `limit` seconds
/// or writes invalid output, the result has the frames so far and the reason in `failure`.
versus::EngineRun run_engine(const std::string& name, const std::string& program,
                             const std::string& question, const trace::Trace& request,
                             double limit);

/// This program's results for some frames of a scenario, with these stages.
trace::Trace run_frames(const Scenario& scenario, const std::vector<int>& frames,
                        const trace::Stages& stages = trace::Stages::none());

/// Prints the first lines of an engine's error output.
void print_words(const versus::EngineRun& engine_run, std::ostream& out);

/// JSON of a judged run: its engine, and its refusal, or failure and error output.
nlohmann::ordered_json engine_json(const versus::EngineRun& engine_run, const std::string& failure);
nlohmann::ordered_json findings_json(const std::vector<lint::Finding>& findings);

/// `versus --rollout`: each engine steps the scenarios itself. Prints a table and draws a picture
/// per scenario, or prints JSON. `programs` are by engine name, without this program.
ExitCode run_rollout(const Options& options, const std::vector<std::string>& engines,
                     const std::map<std::string, std::string>& programs);

class Renderer;

/// One scenario stepped by every engine.
struct Rollout {
  std::string name;  // "group/idea"
  trace::Trace request;
  std::vector<versus::EngineRun> engine_runs{};
  std::vector<versus::RolloutScore> scores{};  // one per engine
};

/// Height, penetration and, if nothing falls, energy over time with a line per engine, above each
/// engine's scene at frame `shown` or its last before. Engines without frames are only named.
Image rollout_picture(const Rollout& rollout, int shown, const std::optional<Size>& size,
                      Renderer& renderer);

}  // namespace contactscope::app
