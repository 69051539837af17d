#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "app/cli/verbs.h"
#include "scenario/scenario.h"
#include "versus/comparison.h"

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

/// This program's results for some frames of a scenario.
trace::Trace run_frames(const Scenario& scenario, const std::vector<int>& frames);

/// Prints the first lines of an engine's error output.
void print_words(const versus::EngineRun& engine_run, std::ostream& out);

/// JSON of a judged run: its engine, and its refusal, or failure and error output.
nlohmann::ordered_json engine_json(const versus::EngineRun& engine_run, const std::string& failure);
nlohmann::ordered_json findings_json(const std::vector<lint::Finding>& findings);

}  // namespace contactscope::app
