#pragma once

#include "app/cli/sequence.h"
#include "app/cli/verbs.h"
#include "scenario/scenario.h"

namespace contactscope::app {

/// Loads the scenarios that a command names: a file, a folder, or a name such as
/// "hull/face_contact" below options.scenario_root or the installed scenarios. Without names, all
/// below the root. Settings of the command line override those of the scenarios. All files are read
/// before anything is returned, so a bad one does not leave half the work done. Throws InputError
/// and UsageError.
std::vector<Scenario> load_scenarios(const Options& options);

/// import.cpp: a scenario file, or the scenario that contactscope-import makes of a model.
/// Throws InputError.
Scenario load_or_import(const std::string& file, bool is_quiet);

/// Input of `render`: a scenario to run, or a trace. For a trace the scenario has only a name and
/// views.
struct Input {
  Scenario scenario;
  std::vector<int> frames{};        // numbers of the frames to draw
  std::optional<Sequence> trace{};  // unset: run the scenario
  std::string file{};               // file name of a trace for messages
  std::string unreadable{};         // error, with only name and path set; empty if readable
};

/// Handling of files that cannot be read or parsed.
enum class Unreadable {
  Thrown,  // as InputError; further errors are printed to stderr
  Kept,    // as an Input with the error
};

/// Folder of the installed scenarios; empty if there is none.
std::string installed_scenarios();

/// True if its name on a command line finds this scenario's file.
bool is_found_by_name(const Scenario& scenario, const Options& options);

/// Like load_scenarios(), but files may be traces, which have one fitted view with the default
/// layers and the summary. Folders include the traces in them. Also throws UsageError for an option that does not apply to traces.
std::vector<Input> load_inputs(const Options& options, Hold hold = Hold::Whole,
                               Unreadable unreadable = Unreadable::Thrown);

/// Visits the arguments in order, for verbs that write no files: several traces may share a name.
/// Scenarios are loaded as by load_inputs(); of a trace only the header has been read.
void each_input(const Options& options, const std::function<void(const Input&)>& scenario,
                const std::function<void(TraceFile&)>& trace);

/// Throws UsageError, with all names, if --reducer names none.
void require_reducer(const std::string& name);

std::vector<View> selected_views(const Scenario& scenario, const Options& options);

/// Names of a list for error messages: "a, b, c".
template <class List> std::string names_of(const List& list) {
  return separated(list, ", ", [](const auto& one) { return one.name; });
}

/// A scenario and the cost of its check, in any unit.
struct Costed {
  std::string name;
  double cost = 1;
};

/// Names in one shard: the costliest first, each to the shard with the least cost so far.
/// Deterministic on every machine for the same names and costs; each name is in exactly one shard.
std::vector<std::string> names_in_shard(std::vector<Costed> scenarios,
                                        const snapshot::Shard& shard);

void keep_shard(std::vector<Input>& inputs, const snapshot::Shard& shard,
                const std::function<double(const Input&)>& cost);

/// Name of the shard's report folder: "check_2_of_5", so that shards with one --out do not collide.
std::string folder_of(const snapshot::Shard& shard);

}  // namespace contactscope::app
