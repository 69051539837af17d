#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/faults.h"
#include "app/cli/narrow.h"
#include "app/render/figure_canvas.h"
#include "app/render/formats/sinks.h"
#include "draw/strip.h"
#include "snapshot/store.h"
#include "vector/font_subset.h"

namespace contactscope::app {
namespace {

// Logs which stages recorded facts and which panels were drawn, for --verbose.
void account_facts(const std::string& name, const std::vector<View>& views,
                   const Sequence& sequence, RunLog& log) {
  int sat = 0, clip = 0, reduction = 0;
  for (const trace::Frame& frame : sequence.frames) {
    for (const trace::Pair& pair : frame.pairs) {
      sat += pair.sat.has_value();
      clip += pair.clip.has_value();
      reduction += pair.reduction.has_value();
    }
  }
  log.note(name + ": recorded sat " + std::to_string(sat) + ", clip " + std::to_string(clip) +
           ", reduction " + std::to_string(reduction) + " times");
  for (const View& view : views) {
    std::string what = name + ": view " + view.name + " paints";
    if (view.layers.empty()) what += " no layers";
    for (const Layer layer : view.layers) what += " " + std::string(name_of(layer));
    what += view.panels.empty() ? "; no panels" : "; panels";
    for (const Panel panel : view.panels) what += " " + std::string(name_of(panel));
    log.note(what);
    if (view.panels.empty())
      log.left_out(name + ": Dear ImGui, because view " + view.name + " has no panel");
  }
}

// Logs the stages that were not needed, for --verbose.
void account_stages(const Scenario& scenario, const trace::Stages& stages, RunLog& log) {
  for (const auto& [recorded, stage] : {std::pair{stages.sat, "sat"},
                                        {stages.clip, "clip"},
                                        {stages.reduction, "reduction"},
                                        {stages.tree, "tree"},
                                        {stages.gjk, "gjk"}}) {
    if (recorded) continue;
    log.left_out(scenario.name + ": record of stage " + stage + ", because no view shows it");
  }
  const bool has_mesh = std::ranges::any_of(scenario.shapes, [](const ScenarioShape& shape) {
    return kind_of(*shape.geometry) == ShapeKind::Mesh;
  });
  if (!has_mesh) log.left_out("bounding volume tree, because no shape is a mesh");
  if (std::ranges::none_of(scenario.shapes, &ScenarioShape::dynamic))
    log.left_out("solver, because no shape is dynamic");
}

/// Default title of an engine's trace: its engine, and the contacts of each frame.
std::string title_of(const trace::Header& header) {
  const std::string engine =
      header.engine + (header.version.empty() ? "" : " " + header.version) + ": ";
  return engine + "{kept:point}, {overlap} deep | " + engine + "{kept:point}, {gap} apart | " +
         engine + "{kept:point}, no overlap | " + engine + "nothing touches";
}

/// Title of a finding, or of a condition without a place, instead of the default one: "Bullet 3.24:
/// contacts of a pair vanish and return (rock 7 and rock 71)".
std::string title_of(const trace::Header& header, const std::string& finding,
                     const Fault::Place& place) {
  std::string text = header.engine + (header.version.empty() ? ": " : " " + header.version + ": ");
  const bool has_name = finding.find("'" + place.a + "'") != std::string::npos;
  if (place.a.empty() || has_name || finding.ends_with(" alone"))
    text += finding;
  else
    text += finding.substr(0, finding.find(", ")) + " (" + name_in_words(place.a) +
            (place.b.empty() ? "" : " and " + name_in_words(place.b)) + ")";
  std::string title;
  for (const char c : text) title += std::string(c == '{' || c == '}' ? 2 : 1, c);
  return title;
}

// Runs the scenario or takes the trace.
Sequence sequence_of(Input& input, std::vector<View>& views, bool every_stage,
                     const Options& options, RunLog& log) {
  Sequence sequence;
  if (input.trace) {
    sequence = std::move(*input.trace);
    // Traces of this program may have an empty title on purpose.
    if (sequence.header.title.empty() && !sequence.header.engine.empty())
      sequence.header.title =
          options.condition.empty()
              ? title_of(sequence.header)
              : title_of(sequence.header, "pairs with " + options.condition, {});
    log.left_out(input.scenario.name + ": the pipeline, because a trace is drawn as it is");
  } else {
    trace::Stages stages = draw::stages_shown(views);
    if (every_stage) stages.sat = stages.clip = stages.reduction = stages.penetration = true;
    sequence = run_sequence(input.scenario, stages, options.timing, log);
    account_stages(input.scenario, stages, log);
  }
  narrow(sequence, options);
  if (!options.condition.empty()) keep_where(sequence, input, views, options);
  account_facts(input.scenario.name, views, sequence, log);
  return sequence;
}

/// Warns about requested layers that stay empty: most traces of engines lack data for many layers.
void report_idle_layers(const Input& input, const draw::Staging& staging, const Sequence& sequence,
                        const Options& options) {
  const bool has_layers = options.layers || views_are_of_file(options);
  if (!input.trace || !has_layers || options.quiet) return;
  const std::vector<std::string> idle = idle_layers(staging, sequence.frames);
  if (idle.empty()) return;
  std::cerr << input.file << ": nothing to draw in layer" << (idle.size() == 1 ? " " : "s ")
            << separated(idle, ", ") << "; src/trace/README.md lists what a trace needs for it\n";
}

/// Default width in pixels.
int page_width(int columns) {
  constexpr int kCell = 400, kMin = 960, kMax = 8192;
  return std::clamp(columns * kCell, kMin, kMax);
}

/// Only scenes: a contact plane has its own captions and no cells.
bool has_cells(const View& view) { return view.kind == ViewKind::Scene; }

/// Size and style of a page of cells; height 0: as needed.
FigureCanvas page_canvas(const trace::Header& header, const std::vector<trace::Frame>& frames,
                         const View& view, const Options& options, int width,
                         const std::shared_ptr<const Words>& words) {
  const bool has_height = options.size || options.height;
  FigureCanvas canvas = canvas_of(header, frames, view, options, Size{width, width}, words);
  if (!has_height) canvas.size.height = 0;
  return canvas;
}

/// True if `render` makes one picture of many cells: --strip or --sheet. Throws UsageError for a
/// conflict of options or formats.
bool wants_cells(const Options& options, const std::vector<const Format*>& formats) {
  if (options.strip && (*options.strip < 2 || *options.strip > 64))
    throw UsageError("--strip " + std::to_string(*options.strip) +
                     " is not a number of frames; write 2 to 64, as --strip 4");
  if (options.columns && (*options.columns < 1 || *options.columns > 64))
    throw UsageError("--columns " + std::to_string(*options.columns) +
                     " is not a number of columns; write 1 to 64, as --columns 2");
  if (options.anchors && (options.strip || options.sheet))
    throw UsageError(std::string("--anchors is for pictures of one frame; leave out ") +
                     (options.strip ? "--strip" : "--sheet"));
  if (options.strip && options.sheet)
    throw UsageError("--strip and --sheet are different pictures; leave out one");
  if (options.columns && !options.strip && !options.sheet)
    throw UsageError("--columns needs --strip or --sheet");
  if (!options.strip && !options.sheet) return false;
  for (const Format* format : formats)
    if (format->encode == nullptr)
      throw UsageError(std::string(options.strip ? "--strip" : "--sheet") +
                       " is one picture, and --format " + std::string(format->name) + " is " +
                       std::string(format->what) + "; leave out one");
  return true;
}

/// `count` evenly spaced frames, including the first and the last.
std::vector<int> evenly(const std::vector<int>& frames, int count) {
  if (count_of(frames) <= count) return frames;
  std::vector<int> chosen;
  for (int i = 0; i < count; ++i) {
    const double place = static_cast<double>(i) * (count_of(frames) - 1) / (count - 1);
    chosen.push_back(at(frames, static_cast<int>(std::lround(place))));
  }
  return chosen;
}

/// --strip: one picture per view, OUT/GROUP/IDEA/[VIEW/]strip.EXTENSION.
void draw_strips(const Input& input, Sequence& sequence, const PictureOrigin& origin,
                 const std::shared_ptr<const Words>& words, const Options& options,
                 Renderer& renderer, Sinks& sinks) {
  const Scenario& scenario = input.scenario;
  std::vector<View> views = selected_views(scenario, options);
  std::erase_if(views, [](const View& view) { return !has_cells(view); });
  if (views.empty())
    throw UsageError("--strip: " + scenario.name +
                     " has only contact planes here, whose cells are already side by side; leave "
                     "out --strip, or name another --view");
  const std::vector<int> chosen = evenly(input.frames, *options.strip);
  std::vector<trace::Frame> shown;
  sequence.each(chosen, [&](std::size_t index) { shown.push_back(sequence.frames[index]); });
  const std::optional<draw::FittedFrames> fitted = fitted_frames(sequence, chosen);
  for (View& view : views) {
    if (!options.panels) view.panels.clear();
    const int columns = options.columns.value_or(draw::usual_columns(count_of(shown)));
    const FigureCanvas canvas =
        page_canvas(sequence.header, sequence.frames, view, options, page_width(columns), words);
    const draw::Strip strip(sequence.header, sequence.frames, shown, view, canvas.size.width,
                            canvas.size.height, columns, canvas.style, fitted ? &*fitted : nullptr);
    draw::Drawing page = strip.page();
    renderer.finish(canvas.style, page);
    int cell = 0;
    renderer.each_drawing(strip.cell(), sequence, chosen,
                          [&](const trace::Frame&, const draw::Drawing& drawing) {
                            strip.place(cell++, drawing, page);
                          });
    const bool is_one_of_several = scenario.views.size() > 1;
    PictureOrigin of_strip = of_view(origin, view, is_one_of_several, options);
    of_strip.frames = separated(chosen, ", ");
    of_strip.command += frames_option(options);
    std::filesystem::path stem = scenario.name;
    if (is_one_of_several) stem /= view.name;
    sinks.add_alone((stem / "strip").string(), scenario.name, of_strip, std::move(page));
  }
}

/// --sheet: the first stored frame of each input, as OUT/GROUP/sheet.EXTENSION, or
/// OUT/sheet.EXTENSION for several groups. `run` makes the sequence of an input.
void draw_sheet(std::vector<Input>& inputs, const std::function<Sequence(Input&)>& run,
                const Options& options, Renderer& renderer, Sinks& sinks, Progress& progress) {
  std::set<std::string> groups;
  for (const Input& input : inputs) {
    const std::string& name = input.scenario.name;
    groups.insert(name.substr(0, name.find('/')));
  }
  const std::string group = groups.size() == 1 ? *groups.begin() : "";
  const int count = count_of(inputs);
  const int columns = options.columns.value_or(draw::usual_columns(count));
  const std::shared_ptr<const Words> words = words_of(inputs.front(), options);
  View none;  // not a scene: thumbnails determine the height
  none.kind = ViewKind::ContactPlane;
  const FigureCanvas canvas = page_canvas({}, {}, none, options, page_width(columns), words);
  const draw::ContactSheet sheet((group.empty() ? "" : group + ": ") + counted(count, "scenario"),
                                 count, canvas.size.width, columns, canvas.style);
  std::vector<draw::ContactSheet::Entry> entries;
  std::vector<draw::Drawing> thumbnails;
  for (Input& input : inputs) {
    add_faults(input, input.frames, options, input.scenario.views);
    const std::vector<View> views = selected_views(input.scenario, options);
    const auto scene = std::ranges::find_if(views, has_cells);
    Sequence sequence = run(input);
    entries.push_back({input.scenario.name, plain_title(sequence.header.title)});
    thumbnails.emplace_back();
    if (scene != views.end()) {
      View view = *scene;
      if (!options.panels) view.panels.clear();
      const std::vector<int>& stored = input.scenario.snapshots.frames;
      const int frame = options.frames || stored.empty() ? input.frames.front() : stored.front();
      const std::optional<draw::FittedFrames> fitted = fitted_frames(sequence, {frame});
      const draw::Staging staging = draw::stage(
          sequence.header, sequence.frames, view, sheet.cell_width(), sheet.cell_height(),
          sheet.thumbnail_style(), draw::kLayers, {}, fitted ? &*fitted : nullptr);
      renderer.each_drawing(staging, sequence, {frame},
                            [&](const trace::Frame& shown, draw::Drawing drawing) {
                              entries.back().title = draw::fill_title(staging, shown);
                              thumbnails.back() = std::move(drawing);
                            });
    }
    progress.advance(input.scenario.name);
  }
  draw::Drawing page = sheet.page(entries);
  renderer.finish(canvas.style, page);
  for (int i = 0; i < count; ++i) sheet.place(i, at(thumbnails, i), page);
  PictureOrigin origin;
  origin.title = group;
  origin.version = CONTACTSCOPE_VERSION;
  origin.command = "contactscope render";
  for (const std::string& name : options.scenarios) origin.command += " " + for_shell(name);
  origin.command += options.given;
  sinks.add_alone((std::filesystem::path(group) / "sheet").string(), group, origin,
                  std::move(page));
}

void draw_sequences(Input& input, const Options& options, Renderer& renderer, Sinks& sinks,
                    Progress& progress, RunLog& log) {
  const Scenario& scenario = input.scenario;
  const std::string finding = add_faults(input, input.frames, options, input.scenario.views);
  std::vector<View> views = selected_views(scenario, options);
  const bool has_title = !input.trace || !input.trace->header.title.empty();
  Sequence sequence = sequence_of(input, views, sinks.needs_stages(), options, log);
  if (options.focus == std::vector<std::string>{"worst"} && !views.empty() && !options.frames &&
      !options.strip && options.condition.empty() &&
      std::ranges::all_of(formats_named(options.formats), &Format::encode)) {
    const draw::ShapeMeshes meshes(sequence.header.shapes);
    const Fault::Place worst = draw::place_in_focus(views[0], sequence.frames, meshes);
    if (!worst.a.empty()) input.frames = {worst.frame};
    const std::string cause = views[0].faults.empty() ? "" : views[0].faults.front().cause;
    if ((cause == "pairs_flicker" || cause == "points_flicker") && !options.quiet)
      std::cerr << "note: the frames around it are seen side by side with --strip 3 --frames "
                << std::max(worst.frame - 1, 0) << ':' << worst.frame + 1 << '\n';
    if (!has_title && !finding.empty())
      sequence.header.title = title_of(sequence.header, finding, worst);
  }
  if (input.frames.empty()) {
    std::cerr << "in no frame of " << scenario.name << " is there a pair with " << options.condition
              << '\n';
    return;
  }
  for (View& view : views) {
    std::vector<std::string> pair = view.focus_on;
    const Fault::Place* const place = view.focus == Focus::Worst ? view.first_fault() : nullptr;
    if (place != nullptr) pair = {place->a, place->b};
    if (view.shows(Panel::Plots) && pair.size() == 2 && !pair[1].empty())
      view.history = sequence.history(pair[0], pair[1]);
  }
  const std::shared_ptr<const Words> words = words_of(input, options);
  // Hashing the file of a trace takes a while.
  auto hashed = std::async(std::launch::async, origin_of, std::cref(input),
                           std::cref(sequence.header), std::cref(options));
  if (options.strip) {
    draw_strips(input, sequence, hashed.get(), words, options, renderer, sinks);
    progress.advance(scenario.name);
    return;
  }
  const std::optional<draw::FittedFrames> fitted = fitted_frames(sequence, input.frames);
  const PictureOrigin origin = hashed.get();
  for (const View& view : views) {
    const FigureCanvas canvas =
        canvas_of(sequence.header, sequence.frames, view, options, Size{}, words);
    const draw::Staging staging = draw::stage(
        sequence.header, sequence.frames, view, canvas.size.width, canvas.size.height, canvas.style,
        draw::kLayers, scenario.snapshots.frames, fitted ? &*fitted : nullptr);
    report_idle_layers(input, staging, sequence, options);
    const bool is_one_of_several = scenario.views.size() > 1;
    sinks.begin({scenario.name, is_one_of_several ? std::optional(view.name) : std::nullopt,
                 of_view(origin, view, is_one_of_several, options), &staging, &sequence,
                 input.frames});
    const auto add = [&](const trace::Frame& frame, draw::Drawing drawing) {
      sinks.add(frame, std::move(drawing));
      progress.advance(scenario.name);
    };
    if (sinks.needs_drawings()) {
      renderer.each_drawing(staging, sequence, input.frames, add);
    } else {
      sequence.each(input.frames, [&](std::size_t index) {
        stop_if_interrupted();
        add(sequence.frames[index], {});
      });
    }
    sinks.end();
  }
}

ExitCode run_render(const Options& options) {
  note_interrupts();
  const std::vector<const Format*> chosen = formats_named(options.formats);
  for (const Format* format : chosen) {
    try {
      if (format->require != nullptr) format->require();
    } catch (const vector::MissingLibrary& missing) {
      throw UsageError("--format " + std::string(format->name) + ": " + missing.what());
    }
  }
  const bool cells = wants_cells(options, chosen);
  RunLog total;
  std::vector<Input> inputs;
  {
    const Timed timed(total, "read scenarios");
    inputs = load_inputs(options, Hold::Sample);
  }
  if (options.shard && options.sheet)
    throw UsageError("--sheet shows all scenarios; leave out --shard");
  if (options.sheet && !options.condition.empty())
    throw UsageError("--sheet shows a frame of each scenario; leave out --where");
  if (!options.condition.empty()) condition_of("--where", options.condition);  // fails early
  if (options.shard)
    keep_shard(inputs, *options.shard, [&](const Input& input) {
      return 1.0 + count_of(input.frames) * count_of(selected_views(input.scenario, options));
    });
  const auto count_pictures = [&] {
    int count = 0;
    for (const Input& input : inputs)
      count +=
          cells ? 1 : count_of(input.frames) * count_of(selected_views(input.scenario, options));
    return count;
  };
  int pictures = count_pictures();

  const auto begin = std::chrono::steady_clock::now();
  Renderer renderer(options.backend, total);
  Sinks sinks(chosen, options, renderer);
  {
    Progress progress(pictures, options.quiet);
    if (options.sheet) {
      const auto run = [&](Input& input) {
        std::vector<View> views = selected_views(input.scenario, options);
        return sequence_of(input, views, false, options, total);
      };
      draw_sheet(inputs, run, options, renderer, sinks, progress);
    } else {
      for (Input& input : inputs) draw_sequences(input, options, renderer, sinks, progress, total);
    }
    sinks.finish();
  }
  pictures = count_pictures();
  if (cells) pictures = sinks.files() / count_of(chosen);
  if (options.json) {
    nlohmann::ordered_json written;
    for (const auto& [scenario, paths] : sinks.written()) written[scenario] = paths;
    std::cout << written.dump() << '\n';
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  const EncoderPool& encoders = sinks.encoders();
  total.add("encode, in parallel",
            std::chrono::duration_cast<std::chrono::nanoseconds>(encoders.busy()), pictures);
  if (options.verbose) {
    total.note("encoder threads: " + std::to_string(encoders.threads()) + ", " +
               std::to_string(pictures / seconds.count()) + " pictures per second");
    total.print(std::cerr, "render");
  }
  if (!options.quiet) renderer.missing_glyphs().report(std::cerr);
  if (!options.quiet) {
    std::filesystem::path where = options.out;
    if (inputs.size() == 1 && !options.sheet) where /= inputs.front().scenario.name;
    if (const int files = sinks.files(); files != pictures)
      std::cerr << counted(files, "file") << " of ";
    std::cerr << counted(pictures, sinks.needs_drawings() ? "picture" : "frame") << " in "
              << where.string() << '\n';
  }
  return pictures > 0 ? ExitCode::Same : ExitCode::Different;
}

}  // namespace

Verb render_verb() {
  return {"render", "Write pictures: PNG, vector files, pages, animations", &run_render};
}

}  // namespace contactscope::app
