#include "draw/scene/layout.h"

#include <algorithm>

#include "draw/scene/palette.h"
#include "draw/scene/pen.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

constexpr double kMargin = 24;
constexpr double kTitleSize = 28;
constexpr double kSourceSize = 14;
constexpr double kPanelColumn = 356;
constexpr double kGutter = 16;
// Letters of 14 px at 720 lines are still 10 px high on the smallest pictures.
constexpr float kLeastScale = 0.72f;

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

}  // namespace

float interface_scale(int width, int height) {
  const double fit = std::min(width / 1280.0, height / 720.0);
  return std::max(kLeastScale, static_cast<float>(fit));
}

std::string fitted(const std::string& text, float size, FontWeight weight, float available) {
  if (text_width(text, size, weight) <= available) return text;
  std::string shortened = text;
  while (!shortened.empty()) {
    // Whole UTF-8 characters only: up to a byte that begins one.
    while (shortened.size() > 1 && (static_cast<unsigned char>(shortened.back()) & 0xC0) == 0x80)
      shortened.pop_back();
    shortened.pop_back();
    if (text_width(shortened + "…", size, weight) <= available) return shortened + "…";
  }
  return shortened;
}

Layout make_layout(int width, int height, bool has_panels,
                   const std::vector<std::vector<float>>& legend_widths, int insets) {
  Layout layout{.width = width, .height = height, .scale = interface_scale(width, height)};
  const double margin = layout.px(kMargin * (layout.scale < 1 ? 0.7 : 1.0));
  const double inner = width - 2 * margin;
  int rows = 0;
  for (const std::vector<float>& widths : legend_widths)
    rows = std::max(rows, rows_of(widths, inner));
  const double top = margin + layout.px(kTitleSize + 14);
  const double source_top = height - margin - layout.px(kSourceSize);
  const double legend_height = rows * layout.px(kLegendRow);
  const double legend_top = source_top - layout.px(8) - legend_height;
  const double column = has_panels ? layout.px(kPanelColumn) : 0;
  const double gutter = has_panels ? layout.px(kGutter) : 0;
  const double view_height = legend_top - layout.px(10) - top;
  layout.view = {margin, top, inner - column - gutter, view_height};
  layout.panels = {width - margin - column, top, column, view_height};
  layout.legend = {margin, legend_top, inner, legend_height};
  if (insets > 0) {
    const double gap = layout.px(kGutter);
    layout.view.width = 0.5 * (layout.view.width - gap);
    const double inset_height = (view_height - (insets - 1) * gap) / insets;
    for (int i = 0; i < insets; ++i)
      layout.insets.push_back({layout.view.right() + gap, top + i * (inset_height + gap),
                               layout.view.width, inset_height});
  }
  return layout;
}

void draw_captions(const std::string& title, const std::string& source, const std::string& moment,
                   const Layout& layout, Drawing& drawing) {
  const float left = static_cast<float>(layout.legend.x);
  const float right = static_cast<float>(layout.legend.right());
  const float bottom = static_cast<float>(layout.height) - left;  // margins are equal
  const float room = right - left;
  const Pen pen(drawing, layout.scale, kSourceSize);
  drawing.begin(kTitlePart);
  pen.text(fitted(title, pen.px(kTitleSize), Weight::Bold, room),
           {left, left + 0.8f * pen.px(kTitleSize)}, Align::Left, kText, Weight::Bold, kTitleSize);
  const float size = pen.px(kSourceSize);
  drawing.begin(kSourcePart);
  pen.text(fitted(source, size, Weight::Regular, room - pen.width_of(moment) - pen.px(kEntryGap)),
           {left, bottom}, Align::Left, kQuietText);
  drawing.begin(kMomentPart);
  pen.text(fitted(moment, size, Weight::Regular, room), {right, bottom}, Align::Right, kQuietText);
}

}  // namespace contactscope::draw
