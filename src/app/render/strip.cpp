#include "app/render/strip.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "app/cli/faults.h"
#include "app/render/figure_canvas.h"
#include "app/render/origin.h"
#include "core/at.h"
#include "draw/strip.h"
#include "snapshot/finding.h"
#include "snapshot/store.h"

namespace contactscope::app {
namespace {

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

}  // namespace

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

std::vector<int> evenly(const std::vector<int>& frames, int count) {
  if (count_of(frames) <= count) return frames;
  std::vector<int> chosen;
  for (int i = 0; i < count; ++i) {
    const double place = static_cast<double>(i) * (count_of(frames) - 1) / (count - 1);
    chosen.push_back(at(frames, static_cast<int>(std::lround(place))));
  }
  return chosen;
}

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
    add_faults(input, input.frames, input.scenario.views);
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

}  // namespace contactscope::app
