#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "app/catalogue.h"
#include "app/encoder_pool.h"
#include "app/interrupt.h"
#include "app/ledger.h"
#include "app/progress.h"
#include "app/studio.h"
#include "app/table.h"
#include "app/verbs.h"
#include "draw/contact_cells.h"
#include "reduce/reducer.h"
#include "study/exploration.h"

namespace contactscope::app {
namespace {

void print_table(const std::vector<trace::Exploration>& explorations, std::ostream& out) {
  Table table({"reducer", "area %", "worst", "moment lost %", "worst", "depth error mm",
               "deepest kept %", "weight held %", "ids changed", "patch/bodies", "ns", "least"});
  for (const ReducerSummary& row : summarize(explorations)) {
    table.add(
        {row.name, spelled("%.2f", 100 * row.mean_area_ratio),
         spelled("%.2f", 100 * row.worst_area_ratio), spelled("%.2f", 100 * row.mean_wrench_error),
         spelled("%.2f", 100 * row.worst_wrench_error),
         spelled("%.3g", 1000 * row.worst_depth_error), spelled("%.0f", 100 * row.deepest_kept),
         spelled("%.0f", 100 * row.supported), std::to_string(row.ids_changed),
         spelled("%.3g", row.moves), row.median > 0 ? spelled("%.0f", row.median) : "-",
         row.min > 0 ? spelled("%.0f", row.min) : "-"});
  }
  table.print(out);
}

// What a reader must know about the numbers, once and on standard error.
void print_note(const std::vector<trace::Exploration>& explorations, const Scenario& scenario) {
  if (explorations.empty()) {
    std::cerr << scenario.name
              << ": nothing touches in these frames, so there is nothing to reduce\n";
    return;
  }
  std::size_t most = 0;
  for (const trace::Exploration& e : explorations) most = std::max(most, e.points.size());
  std::cerr << scenario.name << ": " << explorations.size()
            << (explorations.size() == 1 ? " manifold" : " manifolds") << " of at most " << most
            << " points";
  if (static_cast<int>(most) <= scenario.pairs.front().pipeline.max_points)
    std::cerr << ", which every reducer keeps whole";
  std::cerr << '\n';
}

/// The explorations of each pair, frames in order.
std::vector<std::vector<trace::Exploration>> by_pair(
    const std::vector<trace::Exploration>& explorations) {
  std::vector<std::vector<trace::Exploration>> pairs;
  for (const trace::Exploration& exploration : explorations) {
    const auto same = [&](const std::vector<trace::Exploration>& pair) {
      const trace::Exploration& first = pair.front();
      return first.a == exploration.a && first.b == exploration.b &&
             first.label == exploration.label;
    };
    auto found = std::ranges::find_if(pairs, same);
    if (found == pairs.end()) found = pairs.emplace(pairs.end());
    found->push_back(exploration);
  }
  return pairs;
}

// OUT/explore/<group>/<idea>/[<a>-<b>[-<label>]/]frame_0000.png
std::filesystem::path folder_of(const Options& options, const trace::Exploration& first,
                                bool several) {
  std::filesystem::path folder = std::filesystem::path(options.out) / "explore" / first.scenario;
  if (several) {
    folder /= first.a + "-" + first.b + (first.label.empty() ? "" : "-" + first.label);
  }
  return folder;
}

std::vector<std::string> order_of(const std::vector<trace::Exploration>& explorations) {
  std::vector<std::string> names;
  for (const ReducerSummary& row : summarize(explorations)) names.push_back(row.name);
  return names;
}

void write_pictures(const Scenario& scenario, const std::vector<trace::Exploration>& explorations,
                    const Options& options, Ledger& ledger) {
  const Size size = options.size.value_or(Size{});
  const std::vector<std::vector<trace::Exploration>> pairs = by_pair(explorations);
  Studio studio(options.backend, ledger);
  EncoderPool encoders(options.jobs);
  std::vector<std::string> left_out;
  {
    Progress progress(static_cast<int>(explorations.size()), options.quiet);
    for (const std::vector<trace::Exploration>& pair : pairs) {
      const draw::ContactCells cells(scenario.title, scenario.source, scenario.up,
                                     draw::explored(pair, order_of(pair)), 0, size.width,
                                     size.height);
      left_out = cells.left_out();
      const std::filesystem::path folder = folder_of(options, pair.front(), pairs.size() > 1);
      std::filesystem::create_directories(folder);
      for (std::size_t i = 0; i < pair.size(); ++i) {
        std::array<char, 32> name{};
        std::snprintf(name.data(), name.size(), "frame_%04d.png", pair[i].frame);
        encoders.submit((folder / name.data()).string(), studio.paint(cells.frame(pair[i].frame)));
        progress.advance(scenario.name);
      }
    }
    encoders.finish();
  }
  if (!options.quiet) {
    std::cerr << explorations.size() << (explorations.size() == 1 ? " picture" : " pictures")
              << " in " << folder_of(options, explorations.front(), false).string() << '\n';
    if (!left_out.empty()) {
      std::cerr << size.width << 'x' << size.height << " leaves out ";
      for (const std::string& what : left_out) {
        std::cerr << (&what == &left_out.front() ? "" : ", ") << what;
      }
      std::cerr << "; a larger --size has room for it\n";
    }
  }
}

}  // namespace

ExitCode explore(const Options& options) {
  note_interrupts();
  const std::vector<Scenario> scenarios = load_scenarios(options);
  if (scenarios.size() != 1) throw UsageError("explore takes one scenario");
  const Scenario& scenario = scenarios.front();
  const FrameRange all{0, scenario.frames - 1, 1};
  const std::vector<int> frames = options.frames.value_or(all).select(scenario.frames);

  ExploreOptions explore_options;
  if (!options.reducer.empty()) explore_options.reducers = {options.reducer};
  std::vector<trace::Exploration> explorations =
      contactscope::explore(scenario, frames.back(), explore_options);
  // Frames before the first one asked for ran too: some reducers go by what they kept there.
  std::erase_if(explorations, [&](const trace::Exploration& exploration) {
    return std::ranges::find(frames, exploration.frame) == frames.end();
  });

  if (options.json) {
    for (const trace::Exploration& exploration : explorations) {
      std::cout << trace::to_json_line(exploration) << '\n';
    }
  } else if (!explorations.empty()) {
    print_table(explorations, std::cout);
  }
  if (!options.quiet) print_note(explorations, scenario);
  Ledger ledger;
  if (options.tables_only) {
    ledger.left_out("pictures and OpenGL, for --table asks for the table alone");
  } else if (!explorations.empty()) {
    write_pictures(scenario, explorations, options, ledger);
  }
  if (options.verbose) ledger.print(std::cerr, "explore");
  return ExitCode::Same;
}

}  // namespace contactscope::app
