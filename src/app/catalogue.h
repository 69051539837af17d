#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/verbs.h"
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

/// What `render` draws: a scenario, which is run first, or a trace as it stands. Of a trace the scenario
/// has a name and views alone.
struct Input {
  Scenario scenario;
  std::vector<int> frames{};            // to draw, by number
  std::optional<trace::Trace> trace{};  // else the scenario is run
  std::string file{};                   // of a trace, as messages name it
};

/// The same of files that may be traces too, which have one view: fitted, with the default layers
/// and the summary. Throws UsageError also where an option has no meaning for a trace.
std::vector<Input> load_inputs(const Options& options);

/// The same of each argument by itself: traces of one name are no mistake where nothing is written.
std::vector<Input> load_each(const Options& options);

/// Whether a file is a trace and no scenario: it is named *.jsonl, or begins with '{', as no TOML
/// does; "-", the standard input, is one. False where there is no such file.
bool is_trace_file(const std::string& path);

/// Reads a trace to draw it, ours or another engine's; of "-" from the standard input. Hulls without faces
/// get those of the convex hull of their vertices. Throws InputError, with the line and what
/// would be right, where it cannot be read or does not fit together: a shape without vertices, a
/// frame without a pose for each shape, a pair of shapes that are not there, a normal that is no
/// unit vector, an index beyond a shape's faces.
trace::Trace load_trace(const std::string& path);

/// The same of text that was read already. `name`: of where it is from, in messages.
trace::Trace parse_trace(const std::string& text, const std::string& name);

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
