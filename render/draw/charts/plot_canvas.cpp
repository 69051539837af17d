#include "draw/charts/plot_canvas.h"

#include <algorithm>
#include <cmath>

#include "draw/scene/palette.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

constexpr double kTextSize = 14;
constexpr double kHeading = 22;
constexpr double kUnder = 26;
constexpr double kBetween = 18;
constexpr double kTitle = 28;
constexpr double kLegend = 24;
constexpr double kCaption = 20;

/// Every how many decades a label has room.
int stride(const std::vector<LogAxis::Tick>& ticks, float room) {
  std::vector<float> places;
  for (const LogAxis::Tick& tick : ticks) {
    if (tick.decade) places.push_back(tick.at);
  }
  if (places.size() < 2) return 1;
  const float decade = std::abs(places[1] - places[0]);
  for (const int every : {1, 2, 3, 4, 5, 6}) {
    if (static_cast<float>(every) * decade >= room) return every;
  }
  return 8;
}

int exponent_of(const LogAxis::Tick& tick) {
  return static_cast<int>(std::lround(std::log10(tick.value)));
}

}  // namespace

void PlotCanvas::text(const std::string& what, const Point2& at, Align align, const Color& color,
                      Weight weight) {
  Text result;
  result.text = what;
  result.at = at;
  result.size = px(kTextSize);
  result.weight = weight;
  result.align = align;
  result.color = color;
  out_.primitives.push_back(result);
}

float PlotCanvas::width_of(const std::string& what, Weight weight) const {
  return text_width(what, px(kTextSize),
                    weight == Weight::Bold ? FontWeight::Bold : FontWeight::Regular);
}

void PlotCanvas::line(const Point2& from, const Point2& to, double width, const Color& color,
                      double dash) {
  Stroke stroke{from, to, px(width), color};
  stroke.dash = px(dash);
  stroke.gap = px(0.7 * dash);
  out_.primitives.push_back(stroke);
}

void PlotCanvas::fill(const Rect& rect, const Color& color) {
  const auto left = static_cast<float>(rect.x), top = static_cast<float>(rect.y);
  const auto right = static_cast<float>(rect.x + rect.width);
  const auto bottom = static_cast<float>(rect.y + rect.height);
  out_.primitives.push_back(
      Fill{{{left, top}, {right, top}, {right, bottom}, {left, bottom}}, color});
}

void PlotCanvas::cross(const Point2& at, double radius, const Color& color) {
  const float r = px(radius);
  line({at.x - r, at.y - r}, {at.x + r, at.y + r}, 1.8, color);
  line({at.x - r, at.y + r}, {at.x + r, at.y - r}, 1.8, color);
}

void PlotCanvas::frame(const Rect& area) {
  const auto left = static_cast<float>(area.x), top = static_cast<float>(area.y);
  const auto right = static_cast<float>(area.x + area.width);
  const auto bottom = static_cast<float>(area.y + area.height);
  const Point2 corners[4] = {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
  for (int i = 0; i < 4; ++i) line(corners[i], corners[(i + 1) % 4], 1.2, kPlotBorder);
}

void PlotCanvas::ticks_along(const LogAxis& axis, const Rect& area, bool grid) {
  const std::vector<LogAxis::Tick> ticks = axis.ticks(1e9f);
  const int every = stride(ticks, px(44));
  const auto top = static_cast<float>(area.y);
  const auto bottom = static_cast<float>(area.y + area.height);
  for (const LogAxis::Tick& tick : ticks) {
    if (!tick.decade) continue;
    if (grid) line({tick.at, top}, {tick.at, bottom}, 1, kPlotGrid);
    const bool labelled = exponent_of(tick) % every == 0;
    line({tick.at, bottom}, {tick.at, bottom + px(labelled ? 5 : 3)}, 1.2, kPlotBorder);
    if (!labelled) continue;
    text(spell_tick_error(tick.value, ""), {tick.at, bottom + px(18)}, Align::Center, kQuietText);
  }
}

void PlotCanvas::ticks_up(const LogAxis& axis, const Rect& area, bool grid, bool labels) {
  const std::vector<LogAxis::Tick> ticks = axis.ticks(1e9f);
  const int every = stride(ticks, px(22));
  const auto left = static_cast<float>(area.x);
  const auto right = static_cast<float>(area.x + area.width);
  for (const LogAxis::Tick& tick : ticks) {
    if (!tick.decade) continue;
    const bool labelled = exponent_of(tick) % every == 0;
    if (grid && labelled) line({left, tick.at}, {right, tick.at}, 1, kPlotGrid);
    line({left - px(labelled ? 5 : 3), tick.at}, {left, tick.at}, 1.2, kPlotBorder);
    if (!labelled || !labels) continue;
    text(spell_tick_error(tick.value, ""), {left - px(8), tick.at + px(5)}, Align::Right,
         kQuietText);
  }
}

std::vector<PlotPanel> panels_of(const trace::Study& study) {
  std::vector<PlotPanel> panels;
  for (const trace::StudySeries& series : study.series) {
    auto panel = std::ranges::find(panels, series.panel, &PlotPanel::name);
    if (panel == panels.end()) {
      const std::string& parameter = series.parameter.empty() ? study.parameter : series.parameter;
      panel = panels.insert(panels.end(), PlotPanel{series.panel, parameter, {}});
    }
    panel->series.push_back(&series);
  }
  return panels;
}

std::vector<Rect> panel_areas(const Rect& space, std::size_t count, double left, float scale) {
  const std::size_t rows = count > 2 ? 2 : 1;
  const std::size_t columns = (count + rows - 1) / std::max<std::size_t>(1, rows);
  const double label = scale * left;
  const double between = scale * kBetween;
  const double width = (space.width - label - between * static_cast<double>(columns - 1)) /
                       static_cast<double>(columns);
  const double row = space.height / static_cast<double>(rows);
  std::vector<Rect> areas;
  for (std::size_t i = 0; i < count; ++i) {
    const auto column = static_cast<double>(i % columns);
    const auto line = static_cast<double>(i / columns);
    areas.push_back({space.x + label + column * (width + between),
                     space.y + line * row + scale * kHeading, width,
                     row - scale * (kHeading + kUnder)});
  }
  return areas;
}

std::string spell_context(const trace::StudyContext& context) {
  std::string line;
  for (const std::string& part :
       {context.cpu, context.compiler, context.build_type, context.date.substr(0, 10)}) {
    if (!part.empty()) line += (line.empty() ? "" : " · ") + part;
  }
  return line;
}

PlotPage plot_page(const trace::Study& study, const std::string& shown, int width, int height) {
  const Layout layout = make_layout(width, height, false, {});
  PlotPage page;
  page.scale = layout.scale;
  page.drawing.width = width;
  page.drawing.height = height;
  draw_captions(study.title, "Against " + study.reference, spell_context(study.context), layout,
                page.drawing);
  const double left = layout.legend.x;
  const double top = left + layout.px(kTitle + 4);
  PlotCanvas canvas(page.drawing, layout.scale);
  canvas.text(shown, {static_cast<float>(left), static_cast<float>(top) + layout.px(12)},
              Align::Left, kQuietText);
  const double legend_at = top + layout.px(16 + 0.5 * kLegend);
  page.legend = {static_cast<float>(left), static_cast<float>(legend_at)};
  const double begin = legend_at + layout.px(0.5 * kLegend + 4);
  const double end = height - left - layout.px(kCaption);
  page.panels = {left, begin, layout.legend.width, end - begin};
  return page;
}

}  // namespace contactscope::draw
