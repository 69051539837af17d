#include "draw/series_plots.h"

#include <algorithm>

#include "draw/palette.h"
#include "draw/quantity.h"
#include "draw/series_chart.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kLeastPlot = 46;
constexpr double kMostPlot = 120;
constexpr double kTimeAxis = 20;
constexpr double kNamesRow = 20;
constexpr double kStripHeading = 19;
constexpr double kMostIdStrip = 72;
constexpr double kIdRow = 9;
constexpr double kLeastIdRow = 2.6;

std::vector<SeriesChart> charts_of(const std::vector<TimeSeries>& series) {
  const auto chart = [&](const char* name, const char* unit,
                         std::vector<double> TimeSeries::*values, bool steps) {
    SeriesChart result{name, unit, {}, steps, false};
    for (const TimeSeries& one : series) result.curves.push_back(one.*values);
    return result;
  };
  std::vector<SeriesChart> charts = {
      chart("penetration", "m", &TimeSeries::penetration, false),
      chart("kinetic energy", "J", &TimeSeries::energy, false),
      chart("normal impulses", "N s", &TimeSeries::impulse, false),
      chart("contact points", "", &TimeSeries::points, true),
  };
  std::erase_if(charts, [](const SeriesChart& one) { return one.curves.front().empty(); });
  return charts;
}

/// Only what has been so far.
std::vector<std::vector<IdState>> until(const TimeSeries& series, std::size_t moment) {
  std::vector<std::vector<IdState>> rows = series.ids;
  for (std::vector<IdState>& row : rows) {
    std::fill(row.begin() + static_cast<std::ptrdiff_t>(std::min(moment + 1, row.size())),
              row.end(), IdState::Absent);
  }
  return rows;
}

void draw_names(const std::vector<TimeSeries>& series, double x, double y, float pixel,
                Drawing& drawing) {
  const auto middle = static_cast<float>(y + 0.45 * pixel * kNamesRow);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const SeriesStyle style = series_style(i);
    Stroke swatch{{static_cast<float>(x), middle},
                  {static_cast<float>(x) + 22 * pixel, middle},
                  2.4f * pixel,
                  style.color};
    swatch.dash = pixel * style.dash;
    swatch.gap = 0.6f * swatch.dash;
    drawing.primitives.push_back(swatch);
    x += 28 * pixel;
    chart_text(series[i].name, {static_cast<float>(x), middle + 5 * pixel}, Align::Left, kText,
               pixel, drawing);
    x += text_width(series[i].name, pixel * static_cast<float>(kChartText), FontWeight::Regular) +
         18 * pixel;
  }
}

}  // namespace

void draw_series_plots(const std::vector<TimeSeries>& series, std::size_t moment, double duration,
                       const Rect& rect, float pixel, Drawing& drawing) {
  if (series.empty() || series.front().points.empty()) return;
  const std::size_t frames = series.front().points.size();
  std::vector<SeriesChart> charts = charts_of(series);
  double y = rect.y, room = rect.height - pixel * kTimeAxis;
  if (series.size() > 1) {
    draw_names(series, rect.x, y, pixel, drawing);
    y += pixel * kNamesRow;
    room -= pixel * kNamesRow;
  }
  std::vector<std::vector<IdState>> ids;
  for (const TimeSeries& one : series) {
    const std::vector<std::vector<IdState>> rows = until(one, moment);
    ids.insert(ids.end(), rows.begin(), rows.end());
  }
  const double least = pixel * kLeastPlot;
  const double wanted = std::min(
      {pixel * kMostIdStrip, 0.16 * room, pixel * kIdRow * static_cast<double>(ids.size())});
  double strip = pixel * kStripHeading +
                 std::max(wanted, std::min(0.16 * room,
                                           pixel * kLeastIdRow * static_cast<double>(ids.size())));
  if (ids.empty() || room - strip < least * static_cast<double>(charts.size())) strip = 0;
  while (charts.size() > 1 && room - strip < least * static_cast<double>(charts.size())) {
    charts.pop_back();
  }
  const double height =
      std::min(pixel * kMostPlot, (room - strip) / static_cast<double>(charts.size()));
  for (const SeriesChart& chart : charts) {
    draw_series_chart(chart, moment, {rect.x, y, rect.width, height}, pixel, drawing);
    y += height;
  }
  const double left = rect.x + pixel * kChartGutter;
  const double width = rect.x + rect.width - left;
  if (strip > 0) {
    const auto baseline = static_cast<float>(y + pixel * (kStripHeading - 6));
    chart_text("contact ids, a row each", {static_cast<float>(rect.x), baseline}, Align::Left,
               kText, pixel, drawing);
    draw_id_strip(ids, frames, moment,
                  {left, y + pixel * kStripHeading, width, strip - pixel * (kStripHeading + 4)},
                  pixel, drawing);
    y += strip;
  }
  const auto baseline = static_cast<float>(y + pixel * (kTimeAxis - 4));
  chart_text("0", {static_cast<float>(left), baseline}, Align::Left, kQuietText, pixel, drawing);
  chart_text("time", {static_cast<float>(left + 0.5 * width), baseline}, Align::Center, kQuietText,
             pixel, drawing);
  chart_text(spell_quantity(duration, "s"), {static_cast<float>(left + width), baseline},
             Align::Right, kQuietText, pixel, drawing);
}

}  // namespace contactscope::draw
