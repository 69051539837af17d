#include "draw/charts/series_plots.h"

#include <algorithm>

#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kLeastPlot = 46;
constexpr double kMostPlot = 120;
constexpr double kTimeAxis = 20;
constexpr double kNamesRow = 20;
constexpr double kCurveSwatch = 22;
constexpr double kStripHeading = 19;
constexpr double kMostIdStrip = 72;
constexpr double kStripShare = 0.16;  // of the height of all charts
constexpr double kIdRow = 9;
constexpr double kLeastIdRow = 2.6;
constexpr double kLegibleIdRow = 3.4;  // thinner rows are a solid block

/// Lines of pairs in the charts that have them; the other quantities belong to no pair.
std::vector<SeriesChart> charts_of(const std::vector<TimeSeries>& series, double step) {
  const double unit = step > 0 ? step : 1;
  SeriesChart penetration{"penetration", "m"}, energy{"kinetic energy", "J"},
      impulse{step > 0 ? "normal forces" : "normal impulses", step > 0 ? "N" : "N s"},
      points{"contact points", ""};
  points.steps = true;
  const auto add = [&](const auto& one) {
    penetration.curves.push_back(one.penetration);
    impulse.curves.push_back(one.impulse);
    for (double& value : impulse.curves.back()) value /= unit;
  };
  const bool of_pairs = series.size() == 1 && !series[0].pairs.empty();
  if (of_pairs) {
    std::ranges::for_each(series[0].pairs, add);
  } else {
    std::ranges::for_each(series, add);
  }
  energy.total = points.total = of_pairs;
  for (const TimeSeries& one : series) {
    energy.curves.push_back(one.energy);
    points.curves.push_back(one.points);
  }
  if (series.size() == 1) penetration.subjects = series[0].deepest;
  const std::vector<std::string>& query = series.front().query;
  for (std::size_t f = 1; f < query.size(); ++f) {
    if (query[f].empty() || query[f - 1].empty() || query[f] == query[f - 1]) continue;
    penetration.changes.push_back({f, query[f - 1], query[f]});
  }
  std::vector<SeriesChart> charts = {penetration, energy, impulse, points};
  std::erase_if(charts, [](const SeriesChart& one) { return one.curves.front().empty(); });
  for (SeriesChart& chart : charts) chart.fit();
  return charts;
}

/// The ids of all series; pairs of one series have numbers of their own.
IdHistory ids_of(const std::vector<TimeSeries>& series) {
  std::vector<std::vector<IdState>> rows;
  std::vector<std::size_t> pairs;
  std::size_t before = 0;
  for (const TimeSeries& one : series) {
    rows.insert(rows.end(), one.ids.begin(), one.ids.end());
    for (const std::size_t pair : one.id_pairs) pairs.push_back(before + pair);
    if (!one.id_pairs.empty()) before += std::ranges::max(one.id_pairs) + 1;
  }
  return {rows, pairs};
}

std::vector<std::string> names_of(const std::vector<TimeSeries>& series) {
  std::vector<std::string> names;
  const auto add = [&](const auto& one) { names.push_back(one.name); };
  if (series.size() == 1) {
    std::ranges::for_each(series[0].pairs, add);
  } else {
    std::ranges::for_each(series, add);
  }
  return names;
}

/// The names of the curves, in as many rows as they take. Returns the height of these.
double draw_names(const std::vector<std::string>& names, const Rect& rect, const Pen& pen) {
  if (names.empty()) return 0;
  const float swatch = pen.px(kCurveSwatch + 6);
  double x = rect.x, y = rect.y;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double width = swatch + pen.width_of(names[i]);
    if (x > rect.x && x + width > rect.right()) {
      x = rect.x;
      y += pen.px(kNamesRow);
    }
    const Point2 left = pixel(x, y + 0.45 * pen.px(kNamesRow));
    draw_series_swatch(i, left, kCurveSwatch, pen);
    pen.text(names[i], left + Point2{swatch, pen.px(5)}, Align::Left, kText);
    x += width + pen.px(16);
  }
  return y + pen.px(kNamesRow) - rect.y;
}

}  // namespace

SeriesPlots::SeriesPlots(const std::vector<TimeSeries>& series, double duration, double step)
    : duration_(duration) {
  if (series.empty() || series.front().points.empty()) return;
  charts_ = charts_of(series, step);
  names_ = names_of(series);
  ids_ = ids_of(series);
}

/// 0 where the charts need all the room.
double SeriesPlots::strip_height(double room, const Pen& pen) const {
  if (ids_.row_count() == 0) return 0;
  const auto rows = static_cast<double>(ids_.row_count());
  const double share = kStripShare * room;
  const double wanted = std::min<double>({pen.px(kMostIdStrip), share, pen.px(kIdRow) * rows});
  const double strip =
      pen.px(kStripHeading) + std::max(wanted, std::min(share, pen.px(kLeastIdRow) * rows));
  const double charts = pen.px(kLeastPlot) * static_cast<double>(charts_.size());
  return room - strip < charts ? 0 : strip;
}

void SeriesPlots::draw_ids(std::size_t moment, const Rect& strip, const Pen& pen) const {
  const Rect inner = chart_area(strip, kStripHeading, pen);
  const auto rows = static_cast<double>(ids_.row_count());
  const bool bands = inner.height < pen.px(kLegibleIdRow) * rows && ids_.pair_count() > 1;
  const auto most = static_cast<std::size_t>(inner.height / pen.px(kLeastIdRow));
  std::string text = "contact ids, a row each";
  if (bands && ids_.pair_count() > most) {
    text = "contact ids of the first " + std::to_string(most) + " of " +
           std::to_string(ids_.pair_count()) + " pairs";
  } else if (bands) {
    text = "contact ids by pair, cut where one changes";
  }
  pen.text(text, pixel(strip.x, strip.y + pen.px(kStripHeading - 6)), Align::Left, kText);
  if (bands) {
    ids_.draw_bands(inner, moment, moment + 1, most, pen);
  } else {
    ids_.draw_rows(inner, moment, moment + 1, pen);
  }
}

std::size_t SeriesPlots::draw(std::size_t moment, const Rect& rect, const Pen& pen) const {
  if (charts_.empty()) return 0;
  const double named = draw_names(names_, rect, pen);
  double y = rect.y + named;
  const double room = rect.height - pen.px(kTimeAxis) - named;
  const double strip = strip_height(room, pen);
  const auto fitting = static_cast<std::size_t>(std::max(0.0, room - strip) / pen.px(kLeastPlot));
  const std::size_t shown = std::clamp<std::size_t>(fitting, 1, charts_.size());
  const double height =
      std::min<double>(pen.px(kMostPlot), (room - strip) / static_cast<double>(shown));
  for (std::size_t i = 0; i < shown; ++i, y += height) {
    draw_series_chart(charts_[i], moment, {rect.x, y, rect.width, height}, pen);
  }
  if (strip > 0) draw_ids(moment, {rect.x, y, rect.width, strip}, pen);
  const double gutter = pen.px(kChartGutter);
  draw_time_axis(duration_, rect.x + gutter, rect.width - gutter, y + strip + pen.px(kTimeAxis - 4),
                 pen);
  return charts_.size() - shown;
}

}  // namespace contactscope::draw
