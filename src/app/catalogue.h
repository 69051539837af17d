#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/options.h"
#include "scenario/scenario.h"
#include "trace/json.h"

namespace contactscope::app {

/// Paths of all scenario files under a folder, sorted.
std::vector<std::string> scenario_files(const std::string& root);

/// Loads the scenarios that a command names: a file, a folder with all that is in it, or a name
/// such as "hull/face_contact" under options.scenario_root. No name means all under the root.
/// Settings of the command line that override a scenario's are applied. All files are read before
/// anything is returned, so that a bad one leaves nothing half done. Throws InputError and
/// UsageError.
std::vector<Scenario> load_scenarios(const Options& options);

/// What `render` draws: a scenario, which is run first, or a trace as it stands.
struct Subject {
  std::string name;                   // "<group>/<idea>"
  std::vector<View> views;            // that --view leaves
  bool several_views = false;         // of the file, so that each has a folder
  std::vector<int> frames;            // to draw, by number
  std::optional<Scenario> scenario;   // either this
  std::optional<trace::Trace> trace;  // or this
};

/// The same of files that may be traces too, which have one view: fitted, with the default layers
/// and the summary. Throws UsageError also where an option has no meaning for a trace.
std::vector<Subject> load_subjects(const Options& options);

/// The views that --view leaves.
std::vector<View> selected_views(const Scenario& scenario, const Options& options);

/// The folder of a view's pictures below the scenario's: none when the file has a single view. A
/// view chosen on the command line stays where it would be among the others.
std::optional<std::string> view_folder(const Scenario& scenario, const View& view);

}  // namespace contactscope::app
