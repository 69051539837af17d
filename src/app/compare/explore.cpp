#include <iostream>

#include "app/cli/table.h"
#include "app/render/figure_canvas.h"
#include "app/render/renderer.h"
#include "snapshot/store.h"
#include "study/exploration.h"

namespace contactscope::app {
namespace {

using Explorations = std::vector<trace::Exploration>;

void print_table(const Explorations& explorations, std::ostream& out) {
  Table table = {{"reducer", "area %", "worst", "lost arm % of radius", "worst", "depth error mm",
                  "deepest kept %", "weight held %", "ids changed", "patch/bodies", "ns", "least",
                  "upper quartile"}};
  const auto time = [](double ns) { return ns > 0 ? printed("%.0f", ns) : std::string("-"); };
  for (const ReducerSummary& row : summarize(explorations)) {
    table.push_back(
        {row.name, printed("%.2f", 100 * row.mean_area_ratio),
         printed("%.2f", 100 * row.worst_area_ratio), printed("%.2f", 100 * row.mean_wrench_error),
         printed("%.2f", 100 * row.worst_wrench_error),
         printed("%.3g", 1000 * row.worst_depth_error), printed("%.0f", 100 * row.deepest_kept),
         row.supported ? printed("%.0f", 100 * *row.supported) : "-",
         std::to_string(row.ids_changed), row.moves ? printed("%.3g", *row.moves) : "-",
         time(row.median), time(row.min), time(row.quarter)});
  }
  print(table, out);
}

/// Largest number of points; there is at least one exploration.
int most_points(const Explorations& explorations) {
  return std::ranges::max(
      mapped(explorations, [](const trace::Exploration& one) { return count_of(one.points); }));
}

/// Limit of points per manifold.
int most_kept(const Scenario& scenario) {
  return scenario.pairs.empty() ? scenario.pipeline.max_points
                                : scenario.pairs.front().pipeline.max_points;
}

// Explains the numbers once, on stderr.
void print_note(const Explorations& explorations, const Scenario& scenario) {
  if (explorations.empty()) {
    std::cerr << scenario.name
              << ": no shapes touch in these frames, so there is nothing to reduce\n";
    return;
  }
  const int most = most_points(explorations);
  std::cerr << scenario.name << ": " << counted(count_of(explorations), "manifold")
            << " of at most " << most << " points";
  if (most <= most_kept(scenario)) std::cerr << ", which every reducer keeps whole";
  std::cerr << '\n';
}

/// Groups explorations by pair and mesh triangle, with frames in order.
std::vector<Explorations> by_manifold(const Explorations& explorations) {
  std::vector<Explorations> sequences;
  for (const trace::Exploration& one : explorations) {
    const auto name = [](const trace::Exploration& of) {
      return std::tie(of.a, of.b, of.label, of.triangle);
    };
    auto found = std::ranges::find_if(sequences, [&](const Explorations& sequence) {
      return name(sequence.front()) == name(one);
    });
    if (found == sequences.end()) found = sequences.emplace(sequences.end());
    found->push_back(one);
  }
  return sequences;
}

// OUT/explore/<group>/<idea>/[<a>-<b>[-<label>] or <patch>[-triangle_<k>]/]frame_0000.png
std::filesystem::path folder_of(const Options& options, const trace::Exploration& first,
                                bool several) {
  std::filesystem::path folder = std::filesystem::path(options.out) / "explore" / first.scenario;
  if (several && first.a.empty()) {
    std::string name = first.label;  // free text: must not change the path
    std::ranges::replace_if(
        name, [](char c) { return c == '/' || c == '\\' || c == ' ' || c == '.'; }, '_');
    folder /= name;
  } else if (several) {
    folder /= first.a + "-" + first.b + (first.label.empty() ? "" : "-" + first.label) +
              (first.triangle ? "-triangle_" + std::to_string(*first.triangle) : "");
  }
  return folder;
}

void write_pictures(const Scenario& scenario, const Explorations& explorations,
                    const Options& options, std::shared_ptr<const Words> words, RunLog& log) {
  View plane;
  plane.kind = ViewKind::ContactPlane;
  const auto [size, style] = canvas_of(
      {}, {}, plane, options, roomy_size(explorations.front().reducers.size()), std::move(words));
  std::vector<Explorations> sequences = by_manifold(explorations);
  const bool several = sequences.size() > 1;
  // Skip mesh triangles whose points no reducer drops: in a large mesh, that is most of them.
  std::erase_if(sequences, [&](const Explorations& sequence) {
    return sequence.front().triangle && most_points(sequence) <= most_kept(scenario);
  });
  int pictures = 0;
  for (const Explorations& sequence : sequences) pictures += count_of(sequence);
  std::vector<std::string> left_out;
  if (pictures > 0) {
    Renderer renderer(options.backend, log);
    EncoderPool encoders(options.jobs);
    {
      Progress progress(pictures, options.quiet);
      for (const Explorations& sequence : sequences) {
        const auto order = mapped(summarize(sequence), &ReducerSummary::name);
        const std::string& label = sequence.front().label;
        const bool is_one_of_several = several && !scenario.patches.empty();
        const std::string plain = plain_title(scenario.title);
        const std::string title = !is_one_of_several ? plain
                                  : plain.empty()    ? label
                                                     : plain + ": " + label;
        const draw::ContactCells cells(title, scenario.source, scenario.up,
                                       draw::explored(sequence, order), 0, size.width, size.height,
                                       style, options.rose);
        left_out = cells.left_out();
        const std::filesystem::path folder = folder_of(options, sequence.front(), several);
        std::filesystem::create_directories(folder);
        for (const trace::Exploration& exploration : sequence) {
          const std::string name = snapshot::frame_stem(exploration.frame) + ".png";
          draw::Drawing drawing = cells.frame(exploration.frame);
          renderer.finish(style, drawing);
          encoders.submit((folder / name).string(), renderer.paint(drawing));
          progress.advance(scenario.name);
        }
      }
      encoders.finish();
      if (!options.quiet) renderer.missing_glyphs().report(std::cerr);
    }
  }
  if (options.quiet) return;
  if (pictures > 0)
    std::cerr << counted(pictures, "picture") << " in "
              << folder_of(options, explorations.front(), false).string() << '\n';
  if (const int kept_whole = count_of(explorations) - pictures; kept_whole > 0)
    std::cerr << "no picture of " << counted(kept_whole, "manifold")
              << " on triangles whose points every reducer keeps\n";
  if (left_out.empty()) return;
  std::cerr << size.width << 'x' << size.height << " leaves out " << separated(left_out, ", ")
            << "; a larger --size has room for it\n";
}

ExitCode run_explore(const Options& options) {
  note_interrupts();
  Options of_input = options;
  of_input.reducer.clear();  // it names one to try, not the one that made a trace
  std::vector<Input> inputs = load_inputs(of_input);
  if (inputs.size() != 1) throw UsageError("explore takes one scenario, or one trace");
  Input& input = inputs.front();
  Scenario scenario = input.scenario;
  if (input.trace) {
    scenario.title = input.trace->header.title;
    scenario.source = input.trace->header.source;
    scenario.up = input.trace->header.up;
  }
  if (!scenario.broad_phase.empty())
    throw InputError(scenario.path, 0, 0,
                     "explore follows pairs from frame to frame, but in this scenario a broad "
                     "phase chooses them in each frame; list the pairs to explore as [[pairs]]");
  if (const auto deforming = std::ranges::find_if(scenario.shapes, &ScenarioShape::deforms);
      deforming != scenario.shapes.end())
    throw InputError(scenario.path, 0, 0,
                     "explore compares the moves of contacts with those of bodies, and '" +
                         deforming->name +
                         "' has no such measure, because it deforms; leave out its 'deform'");
  const std::vector<int>& frames = input.frames;
  const std::shared_ptr<const Words> words = words_of(input, options);
  ExploreOptions explore_options;
  if (!options.reducer.empty()) {
    require_reducer(options.reducer);
    explore_options.reducers = {options.reducer};
  }
  explore_options.threads = options.jobs;
  std::optional<Progress> progress;
  std::string stage;
  explore_options.progress = [&](const std::string& what, int total) {
    stop_if_interrupted();
    if (std::exchange(stage, what) != what) progress.emplace(total, options.quiet);
    progress->advance(what);
  };
  Explorations explorations =
      input.trace ? explore({std::move(input.trace->header), std::move(input.trace->frames)},
                            explore_options)
                  : explore(scenario, frames.back(), explore_options);
  progress.reset();
  // Earlier frames ran too, because some reducers depend on the points that they kept before.
  std::erase_if(explorations, [&](const trace::Exploration& exploration) {
    return std::ranges::find(frames, exploration.frame) == frames.end();
  });

  if (options.json) {
    for (const trace::Exploration& exploration : explorations)
      std::cout << trace::to_json_line(exploration) << '\n';
  } else if (!explorations.empty()) {
    print_table(explorations, std::cout);
  }
  if (!options.quiet) print_note(explorations, scenario);
  RunLog log;
  if (options.tables_only) {
    log.left_out("pictures and OpenGL, because of --table");
  } else if (!explorations.empty()) {
    write_pictures(scenario, explorations, options, words, log);
  }
  if (options.verbose) log.print(std::cerr, "explore");
  return ExitCode::Same;
}

}  // namespace

Verb explore_verb() {
  return {"explore", "Compare all reducers on a scenario's manifolds", &run_explore};
}

}  // namespace contactscope::app
