#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/sequence.h"
#include "app/trace_file.h"
#include "app/verbs.h"
#include "scenario/scenario.h"

namespace contactscope::app {

/// Loads the scenarios that a command names: a file, a folder with all that is in it, or a name
/// such as "hull/face_contact" under options.scenario_root, or else one that was installed. No name means all
/// under the root.
/// Settings of the command line that override a scenario's are applied. All files are read before
/// anything is returned, so that a bad one leaves nothing half done. Throws InputError and
/// UsageError.
std::vector<Scenario> load_scenarios(const Options& options);

/// What `render` draws: a scenario, which is run first, or a trace as it stands. Of a trace the scenario
/// has a name and views alone.
struct Input {
  Scenario scenario;
  std::vector<int> frames{};        // to draw, by number
  std::optional<Sequence> trace{};  // else the scenario is run
  std::string file{};               // of a trace, as messages name it
  std::string unreadable{};  // why there is nothing but a name and a path; empty where all is well
};

/// What becomes of a file that cannot be read or parsed.
enum class Unreadable {
  Thrown,  // as InputError, and the messages of the others on the standard error
  Kept,    // as an Input that says so
};

/// The folder of scenarios that the program was installed with; empty where it was with none.
std::string installed_scenarios();

/// Whether its name on a command line stands for this scenario's file.
bool is_found_by_name(const Scenario& scenario, const Options& options);

/// The same of files that may be traces too, which have one view: fitted, with the default layers
/// and the summary. Throws UsageError also where an option has no meaning for a trace.
std::vector<Input> load_inputs(const Options& options, Hold hold = Hold::Whole,
                               Unreadable unreadable = Unreadable::Thrown);

/// Each argument by itself, in their order, where nothing is written, so that traces of one name are no mistake:
/// scenarios as load_inputs() has them, and traces of any length, from which only the header was read.
void each_input(const Options& options, const std::function<void(const Input&)>& scenario,
                const std::function<void(TraceFile&)>& trace);

/// The views that --view leaves.
std::vector<View> selected_views(const Scenario& scenario, const Options& options);

/// The names of a list of things, for a complaint: "a, b, c".
template <class List>
std::string names_of(const List& list) {
  std::string names;
  for (const auto& one : list) names += (names.empty() ? "" : ", ") + one.name;
  return names;
}

}  // namespace contactscope::app
