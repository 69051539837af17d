#include "draw/strip.h"

#include "draw/panels/panel.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kCaptionSize = 15, kCaptionLine = 18, kCaptionRoom = 24, kBetweenCells = 16;
constexpr double kBodyType = 15;  // base size of a style's type
// Text has its size at 720 lines in cells of this width, in pixels; limits for other widths.
constexpr double kUsualCell = 360, kMinType = 0.72, kMaxType = 1.25;
constexpr double kCellShape = 0.75;  // height by width
constexpr double kThumbnailShape = 0.66;

/// Without an author's text size, it follows the width of a cell, because rows are not high.
FigureStyle with_type(FigureStyle style, double cell_width) {
  if (style.type > 0) return style;
  style.type = kBodyType * std::clamp(cell_width / kUsualCell, kMinType, kMaxType);
  return style;
}

CellGrid grid_of(const Rect& room, int cells, int columns, double caption, double gap,
                 double shape) {
  CellGrid grid{.columns = std::min(columns, cells), .x = room.x, .y = room.y, .caption = caption};
  const int rows = (cells + grid.columns - 1) / grid.columns;
  grid.width = static_cast<int>((room.width - (grid.columns - 1) * gap) / grid.columns);
  const double height =
      shape > 0 ? shape * grid.width : (room.height - (rows - 1) * gap) / rows - caption;
  grid.height = static_cast<int>(height);
  grid.across = (room.width - grid.width) / std::max(1, grid.columns - 1);
  grid.down = caption + grid.height + gap;
  return grid;
}

/// Titles of several frames as one: "12 to 14 points"; empty if they differ in more than numbers.
std::string title_of_all(const std::vector<std::string>& titles) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& title : titles) {
    std::istringstream words(title);
    rows.emplace_back(std::istream_iterator<std::string>(words),
                      std::istream_iterator<std::string>());
    if (rows.back().size() != rows.front().size()) return "";
  }
  const auto number = [](std::string word) {
    std::erase(word, ',');
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    return end == word.c_str() ? std::optional<double>() : value;
  };
  std::string all;
  for (std::size_t i = 0; i < rows.front().size(); ++i) {
    const std::vector<std::string> words = mapped(rows, [&](const auto& row) { return row[i]; });
    const auto [least, most] = std::ranges::minmax(words, {}, number);
    std::string word = std::ranges::max(words, {}, &std::string::size), single = word;
    if (const std::size_t s = word.rfind('s'); s != std::string::npos) single.erase(s, 1);
    const auto is_number = [&](const std::string& one) { return number(one).has_value(); };
    if (std::ranges::all_of(words, is_number) && least != most)
      word = least.substr(0, least.find_last_not_of(',') + 1) + " to " + most;
    else if (std::ranges::any_of(words, [&](auto& one) { return one != word && one != single; }))
      return "";
    all += (i > 0 ? " " : "") + word;
  }
  return all;
}

/// Height of a page with this grid of cells; `room`: previous height for the cells.
int height_with(const CellGrid& grid, int cells, double room, double gap, int height) {
  const int rows = (cells + grid.columns - 1) / grid.columns;
  return static_cast<int>(std::ceil(height - room + rows * grid.down - gap));
}

/// Without the heading of its step, which the page writes.
void put(const CellGrid& grid, int i, const Drawing& cell, Drawing& page) {
  const Rect at = grid.cell(i);
  page.append(cell.taken([](const Part& part) { return part.layer != "heading"; }),
              pixel(at.x, at.y));
}

}  // namespace

Rect CellGrid::cell(int i) const {
  return {std::floor(x + i % columns * across), std::floor(y + i / columns * down + caption),
          static_cast<double>(width), static_cast<double>(height)};
}

int usual_columns(int cells) {
  constexpr int kMax = 4;
  const int rows = (cells + kMax - 1) / kMax;
  return (cells + rows - 1) / std::max(1, rows);
}

FigureStyle cell_style(FigureStyle page, float scale) {
  page.title = page.legend = page.footer = false;
  page.margin = 0;
  page.type = kBodyType * scale / page.scale;
  page.height_below = 0;
  return page;
}

Strip::Strip(const trace::Header& header, const std::vector<trace::Frame>& frames,
             const std::vector<trace::Frame>& shown, const View& view, int width, int height,
             int columns, const FigureStyle& style, const FittedFrames* fitted)
    : header_(&header), shown_(&shown), style_(with_type(style, double(width) / columns)) {
  // Use the author's title, with the range of its numbers over the cells. If it says something else
  // in some of them, use the title of the last frame.
  const std::string requested = view.title.value_or(header.title);
  title_ = plain_title(requested);
  if (title_ != requested) {
    lay_out(frames, view, width, height, columns, fitted);
    title_ = title_of_all(
        mapped(shown, [&](const trace::Frame& frame) { return fill_title(*cell_, frame); }));
    if (title_.empty())
      title_ =
          fill_title(*cell_, shown.back()) + " (frame " + std::to_string(shown.back().frame) + ")";
  }
  // The legend follows from the cells, and their size from the rows of the legend.
  lay_out(frames, view, width, height, columns, fitted);
  Legend legend;
  for (const trace::Frame& frame : shown) {
    headings_.push_back(sketch_frame(*cell_, frame).heading);
    if (!style_.legend) continue;
    for (const LegendEntry& entry : legend_of(*cell_, frame).listed)
      legend.explain(*entry.swatch, entry.text);
  }
  legend_ = choose_legend(legend.sorted()).listed;
  const bool any = std::ranges::any_of(headings_, [](const auto& text) { return !text.empty(); });
  if (any || !legend_.empty()) lay_out(frames, view, width, height, columns, fitted);
}

std::vector<std::string> Strip::heading_lines(int i) const {
  if (headings_.empty() || at(headings_, i).empty()) return {};
  const std::string text = page_.words ? page_.words->of(at(headings_, i)) : at(headings_, i);
  return wrapped(text, page_.px(kCaptionSize), static_cast<float>(grid_.width));
}

void Strip::lay_out(const std::vector<trace::Frame>& frames, const View& view, int width,
                    int height, int columns, const FittedFrames* fitted) {
  const int cells = count_of(*shown_);
  const float scale = interface_scale(width, width, style_);
  std::vector<float> widths = mapped(legend_, [&](const LegendEntry& entry) {
    return legend_entry_width(entry, scale, style_.words.get());
  });
  const auto page_of = [&](int high) {
    return make_layout(width, high, false, {widths}, 0, style_, title_);
  };
  page_ = page_of(height > 0 ? height : width);
  const double gap = page_.px(kBetweenCells);
  grid_ = grid_of(page_.view, cells, columns, 0, gap, kCellShape);  // for its width only
  std::size_t lines = 0;
  for (int i = 0; i < count_of(headings_); ++i) lines = std::max(lines, heading_lines(i).size());
  const double caption = page_.px(kCaptionRoom + static_cast<double>(lines) * kCaptionLine);
  if (height <= 0) {
    const CellGrid trial = grid_of(page_.view, cells, columns, caption, gap, kCellShape);
    page_ = page_of(height_with(trial, cells, page_.view.height, gap, width));
  }
  grid_ = grid_of(page_.view, cells, columns, caption, gap, 0);
  cell_.emplace(stage(*header_, frames, view, std::max(grid_.width, 1), std::max(grid_.height, 1),
                      cell_style(style_, page_.scale), kLayers, {}, fitted));
}

Drawing Strip::page() const {
  Drawing drawing{.width = page_.width, .height = page_.height};
  drawing.words = page_.words;
  const Pen pen(drawing, page_.scale, kCaptionSize);
  drawing.begin(kMomentPart);
  for (int i = 0; i < count_of(*shown_); ++i) {
    const Rect at = grid_.cell(i);
    double baseline = at.y - grid_.caption + page_.px(kCaptionLine);
    pen.text(pen.fitted(cell_->moments.of(contactscope::at(*shown_, i)), Weight::Bold,
                        static_cast<float>(at.width)),
             pixel(at.x, baseline), Align::Left, kText, Weight::Bold);
    for (const std::string& line : heading_lines(i)) {
      baseline += page_.px(kCaptionLine);
      pen.text(Said{line}, pixel(at.x, baseline), Align::Left, kText);
    }
  }
  if (style_.legend) draw_legend(legend_, page_, drawing);
  draw_captions(title_, header_->source, "", page_, drawing);
  return drawing;
}

void Strip::place(int i, const Drawing& cell, Drawing& page) const { put(grid_, i, cell, page); }

ContactSheet::ContactSheet(std::string title, int cells, int width, int columns,
                           const FigureStyle& style)
    : title_(std::move(title)), style_(with_type(style, double(width) / columns)) {
  style_.legend = style_.footer = false;
  const auto page_of = [&](int high) {
    return make_layout(width, high, false, {}, 0, style_, title_);
  };
  page_ = page_of(width);
  // Room for a name and two lines of title.
  const double gap = page_.px(kBetweenCells), caption = page_.px(3.6 * kCaptionSize);
  const CellGrid trial = grid_of(page_.view, cells, columns, caption, gap, kThumbnailShape);
  page_ = page_of(height_with(trial, cells, page_.view.height, gap, width));
  grid_ = grid_of(page_.view, cells, columns, caption, gap, kThumbnailShape);
}

Drawing ContactSheet::page(const std::vector<Entry>& entries) const {
  Drawing drawing{.width = page_.width, .height = page_.height};
  drawing.words = page_.words;
  const Pen pen(drawing, page_.scale, kCaptionSize);
  drawing.begin(kTitlePart);
  for (int i = 0; i < count_of(entries); ++i) {
    const Entry& entry = contactscope::at(entries, i);
    const Rect at = grid_.cell(i);
    const auto room = static_cast<float>(at.width);
    double baseline = at.y - grid_.caption + page_.px(kCaptionSize);
    const auto line = [&](const std::string& text, Weight weight, const Color& color) {
      pen.text(pen.fitted(text, weight, room), pixel(at.x, baseline), Align::Left, color, weight);
      baseline += page_.px(1.1 * kCaptionSize);
    };
    line(entry.name, Weight::Bold, kText);
    std::vector<std::string> lines = wrapped(entry.title, page_.px(kCaptionSize), room);
    for (std::size_t l = 2; l < lines.size(); ++l) lines[1] += " " + lines[l];
    for (std::size_t l = 0; l < std::min<std::size_t>(2, lines.size()); ++l)
      line(lines[l], Weight::Regular, kQuietText);
  }
  draw_captions(title_, "", "", page_, drawing);
  return drawing;
}

void ContactSheet::place(int i, const Drawing& thumbnail, Drawing& page) const {
  put(grid_, i, thumbnail, page);
}

}  // namespace contactscope::draw
