#include "draw/charts/plot_page.h"

#include <algorithm>
#include <cmath>

#include "draw/scene/layout.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

constexpr double kHeading = 22;
constexpr double kUnder = 26;
constexpr double kBetween = 18;
constexpr double kTitle = 28;
constexpr double kLegend = 24;
constexpr double kCaption = 20;

/// Every how many decades a label has room.
int stride(const std::vector<Axis::Tick>& ticks, float room) {
  std::vector<float> places;
  for (const Axis::Tick& tick : ticks) {
    if (tick.decade) places.push_back(tick.at);
  }
  if (places.size() < 2) return 1;
  const float decade = std::abs(places[1] - places[0]);
  for (const int every : {1, 2, 3, 4, 5, 6}) {
    if (static_cast<float>(every) * decade >= room) return every;
  }
  return 8;
}

int exponent_of(const Axis::Tick& tick) {
  return static_cast<int>(std::lround(std::log10(tick.value)));
}

}  // namespace

void draw_decades_along(const Axis& axis, const Rect& area, bool grid, const Pen& pen) {
  const std::vector<Axis::Tick> ticks = axis.ticks(1e9f);
  const int every = stride(ticks, pen.px(44));
  const auto top = static_cast<float>(area.y);
  const auto bottom = static_cast<float>(area.y + area.height);
  for (const Axis::Tick& tick : ticks) {
    if (!tick.decade) continue;
    if (grid) pen.line({tick.at, top}, {tick.at, bottom}, 1, kChartGrid);
    const bool labelled = exponent_of(tick) % every == 0;
    pen.line({tick.at, bottom}, {tick.at, bottom + pen.px(labelled ? 5 : 3)}, 1.2, kChartBorder);
    if (!labelled) continue;
    pen.text(spell_tick_error(tick.value, ""), {tick.at, bottom + pen.px(18)}, Align::Center,
             kQuietText);
  }
}

void draw_decades_up(const Axis& axis, const Rect& area, bool grid, bool labels, const Pen& pen) {
  const std::vector<Axis::Tick> ticks = axis.ticks(1e9f);
  const int every = stride(ticks, pen.px(22));
  const auto left = static_cast<float>(area.x);
  const auto right = static_cast<float>(area.x + area.width);
  for (const Axis::Tick& tick : ticks) {
    if (!tick.decade) continue;
    const bool labelled = exponent_of(tick) % every == 0;
    if (grid && labelled) pen.line({left, tick.at}, {right, tick.at}, 1, kChartGrid);
    pen.line({left - pen.px(labelled ? 5 : 3), tick.at}, {left, tick.at}, 1.2, kChartBorder);
    if (!labelled || !labels) continue;
    pen.text(spell_tick_error(tick.value, ""), {left - pen.px(8), tick.at + pen.px(5)},
             Align::Right, kQuietText);
  }
}

void PositiveRange::include(double value) {
  if (!(value > 0)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

double largest_error(const trace::StudyPoint& point) {
  return point.error_worst.value_or(point.error.value_or(0));
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

std::string spell_context(const trace::StudyContext& context, bool with_scalar) {
  std::string line;
  for (const std::string& part : {context.cpu, context.compiler, context.build_type,
                                  with_scalar ? context.scalar : "", context.date.substr(0, 10)}) {
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
  draw_captions(study.title, "Against " + study.reference, spell_context(study.context, false),
                layout, page.drawing);
  const double left = layout.legend.x;
  const double top = left + layout.px(kTitle + 4);
  Pen(page.drawing, layout.scale, kPlotText)
      .text(shown, {static_cast<float>(left), static_cast<float>(top) + layout.px(12)}, Align::Left,
            kQuietText);
  const double legend_at = top + layout.px(16 + 0.5 * kLegend);
  page.legend = {static_cast<float>(left), static_cast<float>(legend_at)};
  const double begin = legend_at + layout.px(0.5 * kLegend + 4);
  const double end = height - left - layout.px(kCaption);
  page.panels = {left, begin, layout.legend.width, end - begin};
  return page;
}

}  // namespace contactscope::draw
