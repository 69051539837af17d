#include "app/catalogue.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>

#include "core/input_error.h"
#include "reduce/reducer.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_named(const std::string& argument, const std::string& root) {
  if (fs::is_directory(argument)) {
    std::vector<std::string> files = scenario_files(argument);
    if (files.empty()) throw InputError(argument, 0, 0, "no scenario (*.toml) in this folder");
    return files;
  }
  if (fs::exists(argument)) return {argument};
  const fs::path named = fs::path(root) / (argument + ".toml");
  if (fs::exists(named)) return {named.string()};
  if (fs::is_directory(fs::path(root) / argument)) {
    return scenario_files((fs::path(root) / argument).string());
  }
  throw InputError(argument, 0, 0,
                   "no such file; give a scenario's path, a folder, or a name that "
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

void require_view(const Scenario& scenario, const std::string& name) {
  std::string names;
  for (const View& view : scenario.views) {
    if (view.name == name) return;
    names += (names.empty() ? "" : ", ") + view.name;
  }
  throw UsageError("--view '" + name + "' is no view of " + scenario.name + "; it has " + names);
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
    if (!is_new) {
      throw InputError(file, 0, 0,
                       "its name " + scenario.name + " is also that of " + known->second +
                           ", and their pictures would overwrite each other; move one to another "
                           "folder, which is the first part of the name");
    }
    if (!options.reducer.empty()) override_reducer(scenario, options.reducer);
    if (!options.view.empty()) require_view(scenario, options.view);
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

}  // namespace contactscope::app
