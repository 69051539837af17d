#include "app/render/figure_canvas.h"

#include <iostream>

#include "app/cli/narrow.h"
#include "draw/panels/panel.h"

namespace contactscope::app {
namespace {

constexpr int kMinSide = 64, kMaxSide = 8192;             // pixels, as for --size
constexpr double kViewShape = 0.7;                        // height of a view relative to its width
constexpr double kChartShape = 0.5;                       // of a chart or map
constexpr double kAroundPanel = 20, kBetweenPanels = 12;  // pixels at 720 lines

int side_of(const char* option, double pixels) {
  const int side = static_cast<int>(std::lround(pixels));
  if (side >= kMinSide && side <= kMaxSide) return side;
  throw UsageError(std::string(option) + " makes " + std::to_string(side) +
                   " pixels, but a picture has 64 to 8192; change --dpi");
}

/// Height in pixels at which panels are complete.
double height_of_panels(const draw::Staging& staging, const std::vector<trace::Frame>& frames) {
  if (frames.empty()) return 0;
  const std::vector<draw::FilledPanel> panels = draw::make_panels(staging, frames);
  double height = 0;
  for (const draw::FilledPanel& panel : panels) {
    const draw::PanelNeed need = panel.content->need({frames.size() - 1, {}});
    // Flexible charts and maps are legible at half their width.
    const double wanted =
        need.wanted > 0 ? double(need.wanted) : kChartShape * staging.layout.panels.width;
    height +=
        std::max<double>(need.good, wanted) + staging.layout.px(kAroundPanel + kBetweenPanels);
  }
  return height;
}

/// Lower end of view, insets and panels.
double end_of(const draw::Layout& layout) {
  double end = layout.view.bottom();
  for (const draw::Rect& inset : layout.insets) end = std::max(end, inset.bottom());
  return layout.panels.width > 0 ? std::max(end, layout.panels.bottom()) : end;
}

/// Sets the height of a canvas from a trial layout.
void fit_height(const trace::Header& header, const std::vector<trace::Frame>& frames,
                const View& view, FigureCanvas& canvas) {
  if (view.kind == ViewKind::ContactPlane) {
    canvas.size.height = side_of("--width", kViewShape * canvas.size.width);
    return;
  }
  const int width = canvas.size.width, trial_height = 2 * width;
  const draw::Staging trial = draw::stage(header, frames, view, width, trial_height, canvas.style);
  const draw::Layout& layout = trial.layout;
  const double gutter = layout.px(16);
  const bool has_panels = layout.panels.width > 0;
  const bool below = has_panels && layout.panels.y >= layout.view.bottom();
  const bool stacked = !layout.insets.empty() && layout.insets.front().y >= layout.view.bottom();
  const double views = stacked ? 1.0 + static_cast<double>(layout.insets.size()) : 1.0;
  const double scenes = views * kViewShape * layout.view.width + (views - 1) * gutter;
  const double panels = has_panels ? height_of_panels(trial, frames) : 0;
  const double around = trial_height - (end_of(layout) - layout.view.y);
  if (below) canvas.style.height_below = panels;
  const double height = around + (below ? scenes + gutter + panels : std::max(scenes, panels));
  canvas.size.height = side_of("--width", height);
}

/// Warns about content that does not fit into a requested height.
void report_left_out(const trace::Header& header, const std::vector<trace::Frame>& frames,
                     const View& view, const FigureCanvas& canvas) {
  if (view.kind == ViewKind::ContactPlane || frames.empty()) return;
  const draw::Staging staging =
      draw::stage(header, frames, view, canvas.size.width, canvas.size.height, canvas.style);
  const draw::Layout& layout = staging.layout;
  const std::vector<draw::FilledPanel> panels = draw::make_panels(staging, frames);
  const std::vector<draw::PanelNeed> needs = mapped(panels, [&](const draw::FilledPanel& panel) {
    draw::PanelNeed need = panel.content->need({frames.size() - 1, {}});
    need.least += layout.px(kAroundPanel);
    return need;
  });
  const std::vector<float> heights =
      draw::divide_column(needs, static_cast<float>(layout.panels.height),
                          layout.px(kBetweenPanels), draw::Sheet::line_height(layout.scale));
  std::string names;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (heights[i] <= 0)
      names += (names.empty() ? "" : ", ") + std::string(name_of(panels[i].panel));
  }
  if (!names.empty())
    std::cerr << header.scenario << ": no room for " << names
              << "; make --height larger, or leave it out\n";
}

std::string words_path(const std::string& named) {
  std::error_code unknown;
  if (std::filesystem::exists(named, unknown)) return named;
  throw UsageError("--words '" + named +
                   "': there is no such file; give a TOML file with a [words] table. `contactscope "
                   "list words` prints its keys");
}

namespace fs = std::filesystem;

std::string hash_of_file(const std::string& path) {
  constexpr std::uintmax_t kMax = 64u << 20;
  std::error_code unknown;
  if (!fs::is_regular_file(path, unknown) || fs::file_size(path, unknown) > kMax) return "";
  try {
    const std::vector<std::uint8_t> bytes = read_whole_file(path);
    return sha256({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  } catch (const std::exception&) {
    return "";
  }
}

/// Prevents a path with a leading dash from being taken for an option.
std::string no_option(const std::string& path) {
  return path.starts_with('-') ? "./" + path : path;
}

/// Argument for a command line: the name of a scenario if it is below the root, else its path.
std::string argument_of(const Input& input, const Options& options) {
  if (input.trace || !input.file.empty())
    return input.file == "standard input" ? "-" : no_option(input.file);
  const Scenario& scenario = input.scenario;
  return is_found_by_name(scenario, options) && scenario.name[0] != '-' ? scenario.name
                                                                        : no_option(scenario.path);
}

}  // namespace

FigureCanvas canvas_of(const trace::Header& header, const std::vector<trace::Frame>& frames,
                       const View& view, const Options& options, Size otherwise,
                       std::shared_ptr<const Words> words) {
  const FigureOptions& figure = options;
  FigureCanvas canvas{options.size.value_or(otherwise), figure.style};
  canvas.style.words = std::move(words);
  if (!figure.width) return canvas;
  canvas.size.width = side_of("--width", figure.width->pixels(figure.dpi));
  if (!figure.height) {
    fit_height(header, frames, view, canvas);
    return canvas;
  }
  canvas.size.height = side_of("--height", figure.height->pixels(figure.dpi));
  if (!options.quiet) report_left_out(header, frames, view, canvas);
  return canvas;
}

std::shared_ptr<const Words> words_of(const Input& input, const Options& options) {
  std::vector<std::string_view> names = names_in_pictures(input.scenario);
  Words words = input.scenario.words;
  if (input.trace)
    for (const trace::Shape& shape : input.trace->header.shapes) names.push_back(shape.name);
  if (!options.words.empty()) words.replace(load_words(words_path(options.words), names));
  return words.empty() ? nullptr : std::make_shared<const Words>(std::move(words));
}

std::shared_ptr<const Words> words_of(const Scenario& scenario) {
  return scenario.words.empty() ? nullptr : std::make_shared<const Words>(scenario.words);
}

draw::Staging stage_cell(const trace::Header& header, const std::vector<trace::Frame>& frames,
                         const View& view, const draw::Rect& cell) {
  draw::FigureStyle on_page;
  on_page.scale = 1.4;  // text on a small canvas must be legible on the page
  int width = static_cast<int>(1.2 * cell.width), height = static_cast<int>(1.5 * cell.height);
  for (int round = 0; round < 2; ++round) {
    const draw::Rect room = draw::stage(header, frames, view, width, height, on_page).layout.view;
    width += static_cast<int>(std::ceil(cell.width - room.width));
    height += static_cast<int>(std::ceil(cell.height - room.height));
  }
  return draw::stage(header, frames, view, width, height, on_page);
}

void paste(const Image& from, const draw::Rect& part, const draw::Rect& cell, Image& to) {
  const int columns = static_cast<int>(std::min(part.width, cell.width));
  const int rows = static_cast<int>(std::min(part.height, cell.height));
  const auto begin = [&](const draw::Rect& rect) {
    return std::pair(static_cast<int>(rect.x + (rect.width - columns) / 2),
                     static_cast<int>(rect.y + (rect.height - rows) / 2));
  };
  const auto [from_x, from_y] = begin(part);
  const auto [x, y] = begin(cell);
  const auto pixel = [](const Image& image, int column, int row) {
    return 3 * static_cast<std::size_t>(row * image.width + column);
  };
  for (int row = 0; row < rows; ++row)
    std::memcpy(&to.rgb[pixel(to, x, y + row)], &from.rgb[pixel(from, from_x, from_y + row)],
                3 * static_cast<std::size_t>(columns));
}

std::string for_shell(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+:,./@%";
  const bool is_plain = word.find_first_not_of(kPlain) == std::string::npos;
  if (is_plain && !word.empty() && word[0] != '=') return word;  // zsh expands "=ls" to a path
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string frames_option(const Options& options) {
  if (!options.frames) return "";
  const auto& [first, last, step] = *options.frames;
  if (last == first) return " --frames " + std::to_string(first);
  return " --frames " + std::to_string(first) + ":" + std::to_string(last) +
         (step == 1 ? "" : ":" + std::to_string(step));
}

PictureOrigin origin_of(const Input& input, const trace::Header& header, const Options& options) {
  PictureOrigin origin;
  origin.version = CONTACTSCOPE_VERSION;
  origin.scenario = input.scenario.name;
  origin.title = plain_title(header.title);
  origin.sha256 = hash_of_file(input.file.empty() ? input.scenario.path : input.file);
  origin.command = "contactscope render " + for_shell(argument_of(input, options)) + options.given;
  return origin;
}

PictureOrigin of_view(PictureOrigin origin, const View& view, bool is_one_of_several,
                      const Options& options) {
  origin.view = view.name;
  if (views_are_of_file(options))
    origin.command += " --view " + for_shell(options.view);
  else if (is_one_of_several)
    origin.command += " --view " + for_shell(view.name);
  return origin;
}

}  // namespace contactscope::app
