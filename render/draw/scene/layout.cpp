#include "draw/scene/layout.h"

#include "draw/scene/clip_story.h"

namespace contactscope::draw {
namespace {

constexpr double kPageMargin = 24, kTitleSize = 28;
constexpr double kMinTitle = 22;  // smaller titles get a second line
constexpr double kTitleOfTwoLines = 19, kMinTwoLines = 15, kSourceSize = 15, kPanelColumn = 356;
constexpr double kGutter = 16;
// Text of 14 px at 720 lines is still 10 px high on the smallest pictures.
constexpr float kMinScale = 0.72f;
constexpr double kBodySize = 15;  // of legends and panels
// In figures with an author's text size titles have lines, and are smaller than the page's.
constexpr double kFigureTitle = 18;
constexpr int kMaxTitleLines = 3;
// If the view would be narrower than this, or than a panel, panels and insets are below it.
constexpr double kMinView = 400;
constexpr double kBelowShare = 0.45;  // share of the height

/// Breaks a title into lines at spaces; the last allowed line contains the rest.
std::vector<std::string> title_lines(const std::string& title, float size, float room, int most) {
  if (most == 1) return {title};
  std::vector<std::string> lines(1);
  std::istringstream words(title);
  for (std::string word; words >> word;) {
    const std::string longer = lines.back().empty() ? word : lines.back() + ' ' + word;
    const bool fits = text_width(longer, size, Weight::Bold) <= room;
    if (fits || lines.back().empty() || static_cast<int>(lines.size()) == most)
      lines.back() = longer;
    else
      lines.push_back(word);
  }
  return lines;
}

int rows_of(const std::vector<float>& widths, double available) {
  int rows = widths.empty() ? 0 : 1;
  double used = 0;
  for (const float width : widths) {
    if (used > 0 && used + width > available) {
      ++rows;
      used = 0;
    }
    used += width;
  }
  return rows;
}

/// Whether the time of each frame is its number. False for a single frame, which proves nothing.
bool counts_frames(const std::vector<trace::Frame>& frames) {
  for (const trace::Frame& frame : frames)
    if (frame.time != frame.frame) return false;
  return frames.size() > 1;
}

/// Number of steps of the story's algorithm, maximum over all frames; 0 if no frame has recorded
/// it.
int recorded_steps(const std::vector<trace::Frame>& frames, Story story) {
  View view;
  view.story = story;
  int most = 0;
  for (const trace::Frame& frame : frames) {
    for (const trace::Pair& pair : frame.pairs) {
      if (story == Story::ClipSteps) {
        // The step after the side planes drops points above the reference face.
        if (pair.clip) most = std::max(most, count_of(pair.clip->steps) + 1);
      } else if (story == Story::WalkSteps) {
        if (pair.query) most = std::max(most, count_of(pair.query->walk) - 1);
      } else if (const auto step = simplex_step(view, frame, pair)) {
        most = std::max(most, step->steps);
      }
    }
  }
  return most;
}

}  // namespace

float interface_scale(int width, int height, const FigureStyle& style) {
  const auto requested = static_cast<float>(style.scale);
  if (style.type > 0) return requested * static_cast<float>(style.type / kBodySize);
  const double fit = std::min(width / 1280.0, height / 720.0);
  return requested * std::max(kMinScale, static_cast<float>(fit));
}

double type_of_em(double em_pixels) { return em_pixels * line_of_em(FontWeight::Regular); }

std::string fitted(const std::string& text, float size, FontWeight weight, float available) {
  if (text_width(text, size, weight) <= available) return text;
  std::string shortened = text;
  while (!shortened.empty()) {
    // Remove whole UTF-8 characters: up to a byte that begins one.
    while (shortened.size() > 1 && (static_cast<unsigned char>(shortened.back()) & 0xC0) == 0x80)
      shortened.pop_back();
    shortened.pop_back();
    if (text_width(shortened + "…", size, weight) <= available) return shortened + "…";
  }
  return shortened;
}

double Layout::footer_baseline() const {
  return height - std::max(page.x, footer ? double(descent(px(kSourceSize), Weight::Regular)) : 0);
}

Layout make_layout(int width, int height, bool has_panels,
                   const std::vector<std::vector<float>>& legend_widths, int insets,
                   const FigureStyle& style, const std::optional<std::string>& title) {
  Layout layout{.width = width, .height = height, .scale = interface_scale(width, height, style)};
  layout.words = style.words.get();
  layout.footer = style.footer;
  layout.ground = !style.background;
  if (style.follows()) layout.title_size = kFigureTitle;
  const double margin =
      layout.px(style.margin.value_or(kPageMargin * (layout.scale < style.scale ? 0.7 : 1.0)));
  const double inner = width - 2 * margin;
  layout.page = {margin, margin, inner, height - 2 * margin};
  if (!style.title || (title && title->empty())) {
    layout.title_lines = 0;
  } else if (title && style.follows()) {
    layout.title_lines = static_cast<int>(
        title_lines(*title, layout.px(layout.title_size), static_cast<float>(inner), kMaxTitleLines)
            .size());
  }
  int rows = 0;
  for (const std::vector<float>& widths : legend_widths)
    rows = std::max(rows, rows_of(widths, inner));
  const double title_height =
      layout.title_lines == 0 ? 0 : layout.px(layout.title_lines * layout.title_size + 14);
  const double top = margin + title_height;
  const double source_top = layout.footer_baseline() - (style.footer ? layout.px(kSourceSize) : 0);
  const double legend_height = rows * layout.px(kLegendRow);
  const double legend_top = source_top - (style.footer ? layout.px(8) : 0) - legend_height;
  const bool is_last = rows == 0 && !style.footer;
  const double room = legend_top - (is_last ? 0 : layout.px(10)) - top;
  const double gutter = layout.px(kGutter), column = layout.px(kPanelColumn);
  const bool is_narrow = style.follows() && inner - column - gutter < layout.px(kMinView);
  layout.view = {margin, top, inner, room};
  layout.legend = {margin, legend_top, inner, legend_height};
  layout.panels = {width - margin, top, 0, room};
  if (has_panels && is_narrow) {
    const double below = style.height_below > 0 ? style.height_below : kBelowShare * room;
    layout.view.height = room - below - gutter;
    layout.panels = {margin, layout.view.bottom() + gutter, inner, below};
  } else if (has_panels) {
    layout.view.width = inner - column - gutter;
    layout.panels = {width - margin - column, top, column, room};
  }
  if (insets > 0 && style.follows() && layout.view.width < layout.px(2 * kMinView)) {
    // Stacked with equal heights, the view first.
    const double each = (layout.view.height - insets * gutter) / (insets + 1);
    layout.view.height = each;
    for (int i = 1; i <= insets; ++i)
      layout.insets.push_back({margin, top + i * (each + gutter), layout.view.width, each});
  } else if (insets > 0) {
    layout.view.width = 0.5 * (layout.view.width - gutter);
    const double inset_height = (room - (insets - 1) * gutter) / insets;
    for (int i = 0; i < insets; ++i)
      layout.insets.push_back({layout.view.right() + gutter, top + i * (inset_height + gutter),
                               layout.view.width, inset_height});
  }
  return layout;
}

FittedTitle fit_title(const std::string& title, float room, float scale) {
  const auto width = [&](const std::string& text, double size) {
    return text_width(text, scale * static_cast<float>(size), Weight::Bold);
  };
  const double whole = width(title, kTitleSize);
  if (whole <= room) return {{title}, kTitleSize};
  // Shrink in steps of a pixel, so that a longer number in the next frame seldom changes the size.
  for (double size = kTitleSize - 1; size >= kMinTitle; --size)
    if (width(title, size) <= room) return {{title}, size};
  for (double size = kTitleOfTwoLines; size >= kMinTwoLines; --size) {
    // The break that makes both lines most alike in width.
    std::optional<std::size_t> best;
    double least = 0;
    for (std::size_t i = title.find(' '); i != std::string::npos; i = title.find(' ', i + 1)) {
      const double wider =
          std::max(width(title.substr(0, i), size), width(title.substr(i + 1), size));
      if (best && wider >= least) continue;
      best = i;
      least = wider;
    }
    if (best && least <= room) return {{title.substr(0, *best), title.substr(*best + 1)}, size};
  }
  return {{fitted(title, scale * static_cast<float>(kMinTitle), Weight::Bold, room)}, kMinTitle};
}

void draw_captions(const std::string& title, const std::string& source, const std::string& moment,
                   const Layout& layout, Drawing& drawing) {
  const float left = static_cast<float>(layout.page.x);
  const float right = static_cast<float>(layout.page.right());
  const auto bottom = static_cast<float>(layout.footer_baseline());
  const float room = right - left;
  const Pen pen(drawing, layout.scale, kSourceSize);
  if (layout.title_lines > 0) {
    drawing.begin(kTitlePart);
    const std::string said = pen.said(title).text;
    // Use the author's size and the layout's number of lines. Otherwise fit the title to the room.
    FittedTitle fit = fit_title(said, room, layout.scale);
    if (layout.title_size != kTitleSize || layout.title_lines > 1)
      fit = {title_lines(said, pen.px(layout.title_size), room, layout.title_lines),
             layout.title_size};
    const float size = pen.px(fit.size);
    double baseline = layout.page.y + 0.8 * size;
    for (const std::string& line : fit.lines) {
      pen.text(Said{fitted(line, size, Weight::Bold, room)}, pixel(left, baseline), Align::Left,
               kText, Weight::Bold, fit.size);
      baseline += (fit.lines.size() > 1 ? 1.15 : 1) * size;
    }
  }
  if (!layout.footer) return;
  const float used = moment.empty() ? 0 : pen.width_of(moment) + pen.px(kEntryGap);
  drawing.begin(kSourcePart);
  pen.text(pen.fitted(source, Weight::Regular, room - used), {left, bottom}, Align::Left,
           kQuietText);
  drawing.begin(kMomentPart);
  pen.text(pen.fitted(moment, Weight::Regular, room), {right, bottom}, Align::Right, kQuietText);
}

Moments::Moments(const std::vector<trace::Frame>& frames, Story story) {
  if (frames.empty()) return;
  const bool record = story != Story::None;
  steps_ = record || counts_frames(frames);
  word_ = record ? "step" : "picture";
  before_first_ = record ? 0 : 1;
  last_ = record ? recorded_steps(frames, story) : 0;
  if (last_ == 0) last_ = frames.back().frame + before_first_;
}

std::string Moments::of(const trace::Frame& frame) const {
  if (!steps_) return printed("frame %d, t = %.3f s", frame.frame, frame.time);
  return printed("%s %d of %d", word_, std::min(frame.frame + before_first_, last_), last_);
}

}  // namespace contactscope::draw
