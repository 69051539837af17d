#include "app/catalogue.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>

#include "app/trace_file.h"
#include "core/input_error.h"
#include "reduce/reducer.h"
#include "scenario/default_view.h"
#include "scenario/nearest_word.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_named(const std::string& argument, const std::string& root) {
  if (fs::is_directory(argument)) {
    std::vector<std::string> files = scenario_files(argument);
    if (files.empty()) throw InputError(argument, 0, 0, "no scenario (*.toml) in this folder");
    return files;
  }
  if (is_trace_file(argument)) {
    throw InputError(argument, 0, 0,
                     "this is a trace, which `render` draws and `doctor` looks through; a scenario "
                     "is needed here");
  }
  if (fs::exists(argument)) return {argument};
  const fs::path named = fs::path(root) / (argument + ".toml");
  if (fs::exists(named)) return {named.string()};
  if (fs::is_directory(fs::path(root) / argument)) {
    return scenario_files((fs::path(root) / argument).string());
  }
  std::vector<std::string> names;
  if (fs::is_directory(root)) {
    for (const std::string& file : scenario_files(root))
      names.push_back(fs::path(file).lexically_relative(root).replace_extension().string());
  }
  const std::string near =
      nearest(argument, std::vector<std::string_view>(names.begin(), names.end()));
  throw InputError(argument, 0, 0,
                   "no such file; " + (near.empty() ? "" : "did you mean " + near + "? else ") +
                       "give a scenario's path, a folder, or a name that "
                       "`contactscope list scenarios` prints");
}

void override_reducer(Scenario& scenario, const std::string& reducer) {
  const std::vector<ReducerInfo>& known = reducers();
  const auto found = std::find_if(known.begin(), known.end(),
                                  [&](const ReducerInfo& info) { return info.name == reducer; });
  if (found == known.end()) {
    std::string names;
    for (const ReducerInfo& info : known) names += (names.empty() ? "" : ", ") + info.name;
    throw UsageError("--reducer '" + reducer + "' is no reducer; known are " + names);
  }
  for (ScenarioPair& pair : scenario.pairs) pair.pipeline.reducer = reducer;
}

void require_view(const std::string& subject, const std::vector<View>& views,
                  const std::string& name) {
  std::string names;
  for (const View& view : views) {
    if (view.name == name) return;
    names += (names.empty() ? "" : ", ") + view.name;
  }
  throw UsageError("--view '" + name + "' is no view of " + subject + "; it has " + names);
}

void refuse_same_name(const std::string& file, const std::string& name, const std::string& other) {
  throw InputError(file, 0, 0,
                   "its name " + name + " is also that of " + other +
                       ", and their pictures would overwrite each other; move one to another "
                       "folder, which is the first part of the name");
}

/// What an author of traces sees without having said what.
View view_of_trace() {
  View view = scenario_file::default_view();
  view.panels = {Panel::Summary};
  return view;
}

Subject subject_of(Scenario&& scenario, const Options& options) {
  Subject subject{
      scenario.name, selected_views(scenario, options), scenario.views.size() > 1, {}, std::nullopt,
      std::nullopt};
  const FrameRange all{0, scenario.frames - 1, 1};
  subject.frames = options.frames.value_or(all).select(scenario.frames);
  subject.scenario = std::move(scenario);
  return subject;
}

Subject subject_of(trace::Trace&& trace, const Options& options) {
  Subject subject{trace.header.scenario, {view_of_trace()}, false, {}, std::nullopt, std::nullopt};
  if (!options.view.empty()) require_view(subject.name, subject.views, options.view);
  for (const trace::Frame& frame : trace.frames) {
    if (!options.frames || options.frames->names(frame.frame))
      subject.frames.push_back(frame.frame);
  }
  if (subject.frames.empty()) {
    throw UsageError("--frames names no frame of " + subject.name + ", which has frames " +
                     std::to_string(trace.frames.front().frame) + " to " +
                     std::to_string(trace.frames.back().frame));
  }
  subject.trace = std::move(trace);
  return subject;
}

}  // namespace

std::vector<std::string> scenario_files(const std::string& root) {
  std::vector<std::string> files;
  if (!fs::is_directory(root)) {
    throw InputError(root, 0, 0,
                     "no such folder; run where scenarios/ is, or name --scenarios DIR");
  }
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    if (entry.is_regular_file() && entry.path().extension() == ".toml") {
      files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<View> selected_views(const Scenario& scenario, const Options& options) {
  std::vector<View> views;
  for (const View& view : scenario.views) {
    if (options.view.empty() || view.name == options.view) views.push_back(view);
  }
  return views;
}

std::optional<std::string> view_folder(const Scenario& scenario, const View& view) {
  if (scenario.views.size() < 2) return std::nullopt;
  return view.name;
}

std::vector<Scenario> load_scenarios(const Options& options) {
  std::vector<std::string> files;
  if (options.scenarios.empty()) {
    files = scenario_files(options.scenario_root);
    if (files.empty()) {
      throw InputError(options.scenario_root, 0, 0,
                       "no scenario (*.toml) here; name one, or run where scenarios/ is");
    }
  }
  for (const std::string& argument : options.scenarios) {
    const std::vector<std::string> named = files_named(argument, options.scenario_root);
    files.insert(files.end(), named.begin(), named.end());
  }
  std::vector<Scenario> scenarios;
  std::map<std::string, std::string> paths;  // by the scenario's name
  for (const std::string& file : files) {
    Scenario scenario = load_scenario(file);
    const auto [known, is_new] = paths.emplace(scenario.name, file);
    if (!is_new && fs::equivalent(known->second, file)) continue;  // named twice
    if (!is_new) refuse_same_name(file, scenario.name, known->second);
    if (!options.reducer.empty()) override_reducer(scenario, options.reducer);
    if (!options.view.empty()) require_view(scenario.name, scenario.views, options.view);
    if (options.frames && options.frames->select(scenario.frames).empty()) {
      throw UsageError("--frames names no frame of " + scenario.name + ", which has frames 0 to " +
                       std::to_string(scenario.frames - 1));
    }
    if (!options.quiet) {
      for (const std::string& warning : scenario.warnings)
        std::fprintf(stderr, "%s: warning: %s\n", file.c_str(), warning.c_str());
    }
    scenarios.push_back(std::move(scenario));
  }
  return scenarios;
}

namespace {

/// A contact plane has layers of its own, and no panels.
void override_views(std::vector<View>& views, const Options& options) {
  for (View& view : views) {
    if (view.kind == ViewKind::ContactPlane) continue;
    view.layers = options.layers.value_or(view.layers);
    view.panels = options.panels.value_or(view.panels);
  }
}

}  // namespace

std::vector<Subject> load_subjects(const Options& options) {
  std::vector<std::string> traces;
  Options others = options;
  std::erase_if(others.scenarios, [&](const std::string& argument) {
    if (!is_trace_file(argument)) return false;
    traces.push_back(argument);
    return true;
  });
  std::vector<Subject> subjects;
  std::map<std::string, std::string> paths;  // by name
  if (traces.empty() || !others.scenarios.empty()) {
    for (Scenario& scenario : load_scenarios(others)) {
      paths.emplace(scenario.name, scenario.path);
      subjects.push_back(subject_of(std::move(scenario), options));
    }
  }
  for (const std::string& file : traces) {
    if (!options.reducer.empty() || options.timing) {
      throw UsageError(std::string(options.timing ? "--timing" : "--reducer") +
                       " runs the pipeline, and " + file +
                       " is a trace of what it decided; leave it out, or name a scenario");
    }
    trace::Trace trace = load_trace(file);
    const auto [known, is_new] = paths.emplace(trace.header.scenario, file);
    if (!is_new && fs::equivalent(known->second, file)) continue;  // named twice
    if (!is_new) refuse_same_name(file, trace.header.scenario, known->second);
    subjects.push_back(subject_of(std::move(trace), options));
  }
  for (Subject& subject : subjects) {
    override_views(subject.views, options);
    if (subject.scenario) override_views(subject.scenario->views, options);
  }
  return subjects;
}

}  // namespace contactscope::app
