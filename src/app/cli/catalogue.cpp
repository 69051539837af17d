#include "app/cli/catalogue.h"

#include "app/cli/narrow.h"
#include "draw/scene/pairs.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;

/// Scenario file of a name below a folder, or all files of a group; empty if neither exists.
std::vector<std::string> files_in(const std::string& root, const std::string& name) {
  std::error_code unknown;
  const fs::path named = fs::path(root) / (name + ".toml");
  if (fs::is_regular_file(named, unknown)) return {named.string()};
  const fs::path group = fs::path(root) / name;
  return fs::is_directory(group, unknown) ? scenario_files(group.string())
                                          : std::vector<std::string>();
}

/// Search path of names: --scenarios, or ./scenarios and then the installed scenarios.
std::vector<std::string> roots_of(const Options& options) {
  std::vector<std::string> roots = {options.scenario_root};
  if (options.scenario_root == Options{}.scenario_root) roots.push_back(installed_scenarios());
  std::erase(roots, "");
  return roots;
}

/// Search order: a regular file or a folder with scenarios, a name below the root, an installed
/// name.
std::vector<std::string> files_named(const std::string& argument, const Options& options) {
  if (is_trace_file(argument)) {
    const std::string what = foreign_in(argument);
    if (!what.empty()) throw InputError(argument, 1, 1, what);
    throw InputError(argument, 0, 0,
                     "this is a trace, for `render`, `lint` and `doctor`; give a scenario here");
  }
  std::error_code unknown;
  if (fs::is_regular_file(argument, unknown)) return {argument};
  const bool is_folder = fs::is_directory(argument, unknown);
  std::vector<std::string> files =
      is_folder ? scenario_files(argument) : std::vector<std::string>();
  const std::vector<std::string> roots = roots_of(options);
  for (const std::string& root : roots)
    if (files.empty()) files = files_in(root, argument);
  if (!files.empty()) return files;
  std::string traces;
  if (is_folder)
    for (const auto& entry : fs::directory_iterator(argument, unknown))
      if (is_trace_file(entry.path().string()))
        traces = "; give its traces, as " + entry.path().string();
  if (is_folder) throw InputError(argument, 0, 0, "no scenario (*.toml) in this folder" + traces);
  require_regular_file(argument, "give the path of a scenario (.toml)");
  std::vector<std::string> names;
  for (const std::string& root : roots) {
    if (!fs::is_directory(root, unknown)) continue;
    for (const std::string& file : scenario_files(root))
      names.push_back(fs::path(file).lexically_relative(root).replace_extension().string());
  }
  // Files next to it: one of this name with an ending comes first.
  const fs::path folder = fs::path(argument).parent_path();
  std::string near;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, unknown)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".toml" && ending != ".jsonl") continue;
    names.push_back((folder / entry.path().filename()).string());
    if (fs::path(names.back()).replace_extension() == argument) near = names.back();
  }
  if (near.empty())
    near = nearest(argument, std::vector<std::string_view>(names.begin(), names.end()));
  throw InputError(argument, 0, 0,
                   "no such file; " +
                       (near.empty() ? "" : "did you mean " + near + "? Otherwise ") +
                       "give a scenario's path, a folder, or a name that "
                       "`contactscope list scenarios` prints");
}

void override_reducer(Scenario& scenario, const std::string& reducer) {
  require_reducer(reducer);
  scenario.pipeline.reducer = reducer;
  for (ScenarioPair& pair : scenario.pairs) pair.pipeline.reducer = reducer;
}

/// Throws UsageError for a scenario without such a triangle.
void choose_triangle(Scenario& scenario, int triangle) {
  scenario.pipeline.triangle = triangle;
  for (ScenarioPair& pair : scenario.pairs) pair.pipeline.triangle = triangle;
  int most = 0;
  for (const ScenarioShape& shape : scenario.shapes)
    if (const Mesh<double>* const mesh = std::get_if<Mesh<double>>(&*shape.geometry))
      most = std::max(most, mesh->triangle_count());
  if (triangle >= most)
    throw UsageError(
        "--triangle " + std::to_string(triangle) + ": " + scenario.name +
        (most == 0 ? " has no mesh"
                   : " has no mesh with more than " + counted(std::size_t(most), "triangle")));
}

void require_view(const Scenario& scenario, const std::string& view) {
  const std::vector<View>& views = scenario.views;
  if (view.empty() || std::ranges::find(views, view, &View::name) != views.end()) return;
  throw UsageError("--view '" + view + "' is not a view of " + scenario.name + "; it has " +
                   names_of(views));
}

/// Scenario name to file.
using Paths = std::map<std::string, std::string>;

/// True if the file is new; throws if another file has the same scenario name.
bool is_new(const std::string& name, const std::string& file, Paths& paths) {
  const auto [known, added] = paths.emplace(name, file);
  if (added) return true;
  if (known->second == file || fs::equivalent(known->second, file)) return false;
  throw InputError(
      file, 0, 0,
      "its name " + name + " is also that of " + known->second +
          ", and their pictures would overwrite each other; " +
          (is_trace_file(file)
               ? "give each an --out of its own, or another `scenario` in its header"
               : "move one to another folder: the folder is the first part of the name"));
}

Input unreadable_input(const std::string& file, const InputError& error) {
  Input input;
  input.scenario.name = printable(scenario_name(file));
  input.scenario.path = file;
  input.unreadable = error.what();
  return input;
}

Input input_of(Sequence&& trace, const Options& options) {
  // Defaults for traces.
  Input input;
  input.scenario.name = trace.header.scenario;
  input.scenario.views = {default_view()};
  View& view = input.scenario.views.front();
  view.panels = {Panel::Summary};
  if (std::ranges::any_of(trace.frames, draw::is_heap)) {
    view.layers = {Layer::Shapes, Layer::Contacts, Layer::Normals};
    view.panels = {Panel::Worst, Panel::Plots};
    view.charts = {Chart::Overlap, Chart::Points};
  }
  // The legend names two shapes; names of very many shapes would hide them.
  constexpr std::size_t kFewest = 3, kMax = 24;
  const std::size_t shapes = trace.header.shapes.size();
  if (shapes >= kFewest && shapes <= kMax) view.layers.push_back(Layer::Names);
  input.trace = std::move(trace);
  if (std::vector<View> views = views_of_file(options); !views.empty())
    input.scenario.views = std::move(views);
  else
    require_view(input.scenario, options.view);
  const std::vector<int>& numbers = input.trace->numbers;
  std::ranges::copy_if(numbers, std::back_inserter(input.frames), [&](int number) {
    return !options.frames || options.frames->names(number);
  });
  const std::vector<int>& frames = input.frames;
  if (frames.empty()) {
    throw UsageError("--frames names no frame of " + input.scenario.name + ", which has frames " +
                     std::to_string(numbers.front()) + " to " + std::to_string(numbers.back()));
  }
  std::vector<int>& stored = input.scenario.snapshots.frames;
  stored = {frames.front(), frames[(frames.size() - 1) / 2], frames.back()};
  stored.erase(std::unique(stored.begin(), stored.end()), stored.end());
  return input;
}

/// Contact plane views keep their own layers and have no panels.
void override_views(std::vector<View>& views, const Options& options) {
  for (View& view : views) {
    if (view.kind == ViewKind::ContactPlane) continue;
    view.layers = options.layers.value_or(view.layers);
    view.panels = options.panels.value_or(view.panels);
  }
  place_camera(views, options);
  place_focus(views, options);
}

/// Adds unreadable ones to `unreadable`, or throws if that is null.
std::vector<Scenario> read_scenarios(const Options& options, std::vector<Input>* unreadable) {
  std::vector<std::string> files;
  if (options.scenarios.empty()) {
    files = scenario_files(options.scenario_root);
    if (files.empty()) {
      throw InputError(
          options.scenario_root, 0, 0,
          "there is no scenario (*.toml) here; name one, or run in the folder with scenarios/");
    }
  }
  for (const std::string& argument : options.scenarios) {
    const std::vector<std::string> named = files_named(argument, options);
    files.insert(files.end(), named.begin(), named.end());
  }
  std::vector<Scenario> scenarios;
  Paths paths;
  std::optional<InputError> refused;
  for (const std::string& file : files) {
    Scenario scenario;
    try {
      scenario = load_or_import(file, options.quiet);
    } catch (const InputError& error) {
      if (unreadable != nullptr) {
        Input input = unreadable_input(file, error);
        if (is_new(input.scenario.name, file, paths)) unreadable->push_back(std::move(input));
        continue;
      }
      if (refused) std::fprintf(stderr, "%s\n", refused->what());
      refused = error;  // go on, to report all errors in one run
      continue;
    }
    if (!is_new(scenario.name, file, paths)) continue;
    if (!options.reducer.empty()) override_reducer(scenario, options.reducer);
    if (options.triangle) choose_triangle(scenario, *options.triangle);
    require_view(scenario, options.view);
    if (options.frames && options.selected(scenario.frames).empty()) {
      throw UsageError("--frames names no frame of " + scenario.name + ", which has frames 0 to " +
                       std::to_string(scenario.frames - 1));
    }
    if (!options.quiet) {
      for (const std::string& warning : scenario.warnings)
        std::fprintf(stderr, "%s: warning: %s\n", file.c_str(), warning.c_str());
    }
    scenarios.push_back(std::move(scenario));
  }
  if (refused) throw InputError(*refused);
  return scenarios;
}

/// The traces next to the scenarios of the folders and groups which the command names, unless an
/// option is for scenarios alone.
std::vector<std::string> stored_traces(const Options& options) {
  std::vector<std::string> folders = options.scenarios, traces;
  if (folders.empty()) folders = {options.scenario_root};
  if (!options.reducer.empty() || options.triangle || options.timing || !options.view.empty() ||
      options.frames)
    folders.clear();
  std::error_code unknown;
  for (std::string& folder : folders) {
    if (!fs::is_directory(folder, unknown)) folder = fs::path(options.scenario_root) / folder;
    if (!fs::is_directory(folder, unknown)) continue;
    for (std::string& trace : scenario_files(folder, ".jsonl")) traces.push_back(std::move(trace));
  }
  return traces;
}

}  // namespace

void require_reducer(const std::string& name) { word_in("--reducer", name, names_in(reducers())); }

std::string installed_scenarios() {
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  const fs::path installed =
      program.parent_path().parent_path() / "share" / "contactscope" / "scenarios";
  return fs::is_directory(installed, unknown) ? installed.string() : "";
}

bool is_found_by_name(const Scenario& scenario, const Options& options) {
  for (const std::string& root : roots_of(options)) {
    const std::vector<std::string> files = files_in(root, scenario.name);
    if (!files.empty())
      return fs::path(scenario.path).lexically_normal() ==
             fs::path(files.front()).lexically_normal();
  }
  return false;
}

std::vector<View> selected_views(const Scenario& scenario, const Options& options) {
  std::vector<View> views = scenario.views;
  std::erase_if(views, [&](const View& view) {
    const bool by_file = views_are_of_file(options);
    return !by_file && !options.view.empty() && view.name != options.view;
  });
  return views;
}

std::vector<Scenario> load_scenarios(const Options& options) {
  return read_scenarios(options, nullptr);
}

std::vector<Input> load_inputs(const Options& options, Hold hold, Unreadable unreadable) {
  std::vector<std::string> traces;
  Options others = options;
  std::erase_if(others.scenarios, [&](const std::string& argument) {
    if (is_trace_file(argument)) traces.push_back(argument);
    return is_trace_file(argument);
  });
  std::vector<Input> inputs;
  Paths paths;
  if (traces.empty() || !others.scenarios.empty()) {
    const std::vector<std::string> stored = stored_traces(others);
    traces.insert(traces.end(), stored.begin(), stored.end());
    const bool is_kept = unreadable == Unreadable::Kept;
    for (Scenario& scenario : read_scenarios(others, is_kept ? &inputs : nullptr)) {
      paths.emplace(scenario.name, scenario.path);
      const std::vector<int> frames = options.selected(scenario.frames);
      inputs.push_back({std::move(scenario), frames});
    }
  }
  for (const std::string& file : traces) {
    if (!options.reducer.empty() || options.triangle || options.timing) {
      throw UsageError(std::string(options.timing     ? "--timing"
                                   : options.triangle ? "--triangle"
                                                      : "--reducer") +
                       " changes the pipeline, but " + file +
                       " is a trace of its results; leave it out, or name a scenario");
    }
    try {
      Sequence trace = read_sequence(file, hold);
      if (is_new(trace.header.scenario, file, paths))
        inputs.push_back(input_of(std::move(trace), options));
      inputs.back().file = file == "-" ? "standard input" : file;
    } catch (const InputError& error) {
      if (unreadable != Unreadable::Kept) throw;
      inputs.push_back(unreadable_input(file, error));
    }
  }
  for (Input& input : inputs) override_views(input.scenario.views, options);
  return inputs;
}

void each_input(const Options& options, const std::function<void(const Input&)>& scenario,
                const std::function<void(TraceFile&)>& trace) {
  const auto visit = [&](const std::string& path) {
    TraceFile file(path);
    trace(file);
  };
  for (const std::string& argument : options.scenarios) {
    if (is_trace_file(argument)) {
      visit(argument);
      continue;
    }
    Options one = options;
    one.scenarios = {argument};
    for (const Input& input : load_inputs(one)) input.trace ? visit(input.file) : scenario(input);
  }
}

std::vector<std::string> names_in_shard(std::vector<Costed> scenarios,
                                        const snapshot::Shard& shard) {
  std::ranges::sort(scenarios, [](const Costed& a, const Costed& b) {
    return a.cost != b.cost ? a.cost > b.cost : a.name < b.name;
  });
  std::vector<double> load(static_cast<std::size_t>(shard.of));
  std::vector<std::string> names;
  for (const Costed& scenario : scenarios) {
    const auto least = std::ranges::min_element(load);
    *least += scenario.cost;
    if (least - load.begin() == shard.part - 1) names.push_back(scenario.name);
  }
  std::ranges::sort(names);
  return names;
}

void keep_shard(std::vector<Input>& inputs, const snapshot::Shard& shard,
                const std::function<double(const Input&)>& cost) {
  const auto costed = [&](const Input& input) { return Costed{input.scenario.name, cost(input)}; };
  const std::vector<std::string> own = names_in_shard(mapped(inputs, costed), shard);
  std::erase_if(inputs, [&](const Input& input) {
    return !std::ranges::binary_search(own, input.scenario.name);
  });
}

std::string folder_of(const snapshot::Shard& shard) {
  return "check_" + std::to_string(shard.part) + "_of_" + std::to_string(shard.of);
}

}  // namespace contactscope::app
