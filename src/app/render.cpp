#include <algorithm>
#include <filesystem>
#include <iostream>

#include "app/catalogue.h"
#include "app/encoder_pool.h"
#include "app/interrupt.h"
#include "app/ledger.h"
#include "app/progress.h"
#include "app/sequence.h"
#include "app/studio.h"
#include "app/verbs.h"
#include "draw/stages_shown.h"
#include "draw/staging.h"
#include "snapshot/store.h"

namespace contactscope::app {
namespace {

std::vector<std::size_t> selected_frames(const Options& options, const Scenario& scenario) {
  const FrameRange all{0, scenario.frames - 1, 1};
  std::vector<std::size_t> which;
  for (const int frame : options.frames.value_or(all).select(scenario.frames)) {
    which.push_back(static_cast<std::size_t>(frame));
  }
  return which;
}

// Which stages left facts, which panels were drawn, and what this scene did without, for --verbose.
void account(const Scenario& scenario, const std::vector<View>& views, const trace::Stages& stages,
             const Sequence& sequence, Ledger& ledger) {
  int sat = 0, clip = 0, reduction = 0;
  for (const trace::Frame& frame : sequence.frames) {
    for (const trace::Pair& pair : frame.pairs) {
      sat += pair.sat.has_value();
      clip += pair.clip.has_value();
      reduction += pair.reduction.has_value();
    }
  }
  ledger.note(scenario.name + ": recorded sat " + std::to_string(sat) + ", clip " +
              std::to_string(clip) + ", reduction " + std::to_string(reduction) + " times");
  for (const View& view : views) {
    std::string what = scenario.name + ": view " + view.name + " paints";
    for (const std::string& layer : view.layers) what += " " + layer;
    what += view.panels.empty() ? "; no panels" : "; panels";
    for (const std::string& panel : view.panels) what += " " + panel;
    ledger.note(what);
    if (view.panels.empty()) {
      ledger.left_out(scenario.name + ": Dear ImGui, for view " + view.name + " names no panel");
    }
  }
  for (const auto& [recorded, stage] : {std::pair{stages.sat, "sat"},
                                        {stages.clip, "clip"},
                                        {stages.reduction, "reduction"},
                                        {stages.tree, "tree"},
                                        {stages.gjk, "gjk"}}) {
    if (recorded) continue;
    ledger.left_out(scenario.name + ": record of stage " + stage + ", for no view shows it");
  }
  const bool has_mesh = std::ranges::any_of(scenario.shapes, [](const ScenarioShape& shape) {
    return kind_of(*shape.geometry) == ShapeKind::Mesh;
  });
  if (!has_mesh) ledger.left_out("bounding volume tree, for no shape is a mesh");
  const bool has_body = std::ranges::any_of(
      scenario.shapes, [](const ScenarioShape& shape) { return shape.body.has_value(); });
  if (!has_body) ledger.left_out("solver, for no shape is dynamic");
}

}  // namespace

ExitCode render(const Options& options) {
  note_interrupts();
  Ledger total;
  std::vector<Scenario> scenarios;
  {
    const Timed timed(total, "read scenarios");
    scenarios = load_scenarios(options);
  }
  int pictures = 0;
  for (const Scenario& scenario : scenarios) {
    pictures += static_cast<int>(selected_frames(options, scenario).size() *
                                 selected_views(scenario, options).size());
  }

  const auto begin = std::chrono::steady_clock::now();
  Studio studio(options.backend, total);
  EncoderPool encoders(options.jobs);
  {
    Progress progress(pictures, options.quiet);
    for (const Scenario& scenario : scenarios) {
      const trace::Stages stages = draw::stages_shown(selected_views(scenario, options));
      const Sequence sequence = run_sequence(scenario, stages, options.timing, total);
      account(scenario, selected_views(scenario, options), stages, sequence, total);
      for (const View& view : selected_views(scenario, options)) {
        const Size size = options.size.value_or(Size{});
        const draw::Staging staging =
            draw::stage(sequence.header, sequence.frames, view, size.width, size.height);
        studio.render(staging, sequence.frames, selected_frames(options, scenario),
                      sequence.nanoseconds, [&](std::size_t frame, Image image) {
                        const snapshot::PictureKey key{scenario.name, view_folder(scenario, view),
                                                       static_cast<int>(frame)};
                        const std::filesystem::path path = snapshot::picture_path(options.out, key);
                        std::filesystem::create_directories(path.parent_path());
                        encoders.submit(path.string(), std::move(image));
                        progress.advance(scenario.name);
                      });
      }
    }
    encoders.finish();
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  total.add("encode, beside the rest",
            std::chrono::duration_cast<std::chrono::nanoseconds>(encoders.busy()), pictures);
  if (options.verbose) {
    total.note(std::to_string(encoders.threads()) + " encoder thread(s), " +
               std::to_string(pictures / seconds.count()) + " pictures a second");
    total.print(std::cerr, "render");
  }
  if (!options.quiet) {
    std::filesystem::path where = options.out;
    if (scenarios.size() == 1) where /= scenarios.front().name;
    std::cerr << pictures << (pictures == 1 ? " picture" : " pictures") << " in " << where.string()
              << '\n';
  }
  return ExitCode::Same;
}

}  // namespace contactscope::app
