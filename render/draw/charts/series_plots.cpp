#include "draw/charts/series_plots.h"

#include <algorithm>

#include "draw/charts/series_chart.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
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
constexpr double kLegibleIdRow = 3.4;  // thinner rows are a solid block

std::vector<double> divided(std::vector<double> values, double by) {
  for (double& value : values) value /= by;
  return values;
}

/// Lines of pairs in the charts that have them; the other quantities belong to no pair.
std::vector<SeriesChart> charts_of(const std::vector<TimeSeries>& series, std::size_t moment,
                                   double step) {
  const std::vector<PairSeries>* pairs =
      series.size() == 1 && !series[0].pairs.empty() ? &series[0].pairs : nullptr;
  const double unit = step > 0 ? step : 1;
  SeriesChart penetration{"penetration", "m"}, energy{"kinetic energy", "J"},
      impulse{step > 0 ? "normal forces" : "normal impulses", step > 0 ? "N" : "N s"},
      points{"contact points", ""};
  points.steps = true;
  energy.total = points.total = pairs != nullptr;
  if (pairs != nullptr) {
    for (const PairSeries& pair : *pairs) {
      penetration.curves.push_back(pair.penetration);
      impulse.curves.push_back(divided(pair.impulse, unit));
    }
  }
  for (const TimeSeries& one : series) {
    energy.curves.push_back(one.energy);
    points.curves.push_back(one.points);
    if (pairs != nullptr) continue;
    penetration.curves.push_back(one.penetration);
    impulse.curves.push_back(divided(one.impulse, unit));
  }
  if (series.size() == 1 && moment < series[0].deepest.size()) {
    penetration.subject = series[0].deepest[moment];
  }
  const std::vector<std::string>& query = series.front().query;
  for (std::size_t f = 1; f < query.size(); ++f) {
    if (query[f].empty() || query[f - 1].empty() || query[f] == query[f - 1]) continue;
    penetration.changes.push_back({f, query[f - 1], query[f]});
  }
  std::vector<SeriesChart> charts = {penetration, energy, impulse, points};
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

std::vector<std::string> names_of(const std::vector<TimeSeries>& series) {
  std::vector<std::string> names;
  if (series.size() == 1) {
    for (const PairSeries& pair : series[0].pairs) names.push_back(pair.name);
  } else {
    for (const TimeSeries& one : series) names.push_back(one.name);
  }
  return names;
}

/// Returns the height of the rows, or draws them too.
double names_rows(const std::vector<std::string>& names, const Rect& rect, float pixel,
                  Drawing* drawing) {
  if (names.empty()) return 0;
  double x = rect.x, y = rect.y;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double width = 28 * pixel + text_width(names[i], pixel * static_cast<float>(kChartText),
                                                 FontWeight::Regular);
    if (x > rect.x && x + width > rect.x + rect.width) {
      x = rect.x;
      y += pixel * kNamesRow;
    }
    if (drawing != nullptr) {
      const auto left = static_cast<float>(x);
      const auto middle = static_cast<float>(y + 0.45 * pixel * kNamesRow);
      const SeriesStyle style = series_style(i);
      Stroke swatch{{left, middle}, {left + 22 * pixel, middle}, 2.4f * pixel, style.color};
      swatch.dash = pixel * style.dash;
      swatch.gap = 0.6f * swatch.dash;
      drawing->primitives.push_back(swatch);
      chart_text(names[i], {left + 28 * pixel, middle + 5 * pixel}, Align::Left, kText, pixel,
                 *drawing);
    }
    x += width + 16 * pixel;
  }
  return y + pixel * kNamesRow - rect.y;
}

/// The rows of all series by pair, those of one pair next to each other.
struct IdRows {
  std::vector<std::vector<IdState>> states;
  std::vector<std::size_t> pairs;
  std::size_t pair_count = 0;
};

IdRows id_rows(const std::vector<TimeSeries>& series, std::size_t moment) {
  IdRows all;
  for (const TimeSeries& one : series) {
    const std::vector<std::vector<IdState>> rows = until(one, moment);
    std::size_t pairs = 0;
    for (const std::size_t pair : one.id_pairs) pairs = std::max(pairs, pair + 1);
    for (std::size_t pair = 0; pair < pairs; ++pair) {
      for (std::size_t row = 0; row < rows.size(); ++row) {
        if (one.id_pairs[row] != pair) continue;
        all.states.push_back(rows[row]);
        all.pairs.push_back(all.pair_count + pair);
      }
    }
    all.pair_count += pairs;
  }
  return all;
}

}  // namespace

std::size_t draw_series_plots(const std::vector<TimeSeries>& series, std::size_t moment,
                              double duration, const Rect& rect, float pixel, Drawing& drawing,
                              double step) {
  if (series.empty() || series.front().points.empty()) return 0;
  const std::size_t frames = series.front().points.size();
  std::vector<SeriesChart> charts = charts_of(series, moment, step);
  const std::vector<std::string> names = names_of(series);
  const double named = names_rows(names, rect, pixel, &drawing);
  double y = rect.y + named, room = rect.height - pixel * kTimeAxis - named;
  const IdRows ids = id_rows(series, moment);
  const auto id_count = static_cast<double>(ids.states.size());
  const double least = pixel * kLeastPlot;
  const double wanted = std::min({pixel * kMostIdStrip, 0.16 * room, pixel * kIdRow * id_count});
  double strip = pixel * kStripHeading +
                 std::max(wanted, std::min(0.16 * room, pixel * kLeastIdRow * id_count));
  if (ids.states.empty() || room - strip < least * static_cast<double>(charts.size())) strip = 0;
  const std::size_t all_charts = charts.size();
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
    const Rect inner{left, y + pixel * kStripHeading, width, strip - pixel * (kStripHeading + 4)};
    const bool bands = inner.height < pixel * kLegibleIdRow * id_count && ids.pair_count > 1;
    chart_text(bands ? "contact ids by pair, cut where one changes" : "contact ids, a row each",
               {static_cast<float>(rect.x), baseline}, Align::Left, kText, pixel, drawing);
    if (bands) {
      draw_id_bands(ids.states, ids.pairs, frames, moment, inner, pixel, drawing);
    } else {
      draw_id_strip(ids.states, frames, moment, inner, pixel, drawing);
    }
    y += strip;
  }
  const auto baseline = static_cast<float>(y + pixel * (kTimeAxis - 4));
  chart_text("0", {static_cast<float>(left), baseline}, Align::Left, kQuietText, pixel, drawing);
  chart_text("time", {static_cast<float>(left + 0.5 * width), baseline}, Align::Center, kQuietText,
             pixel, drawing);
  chart_text(spell_quantity(duration, "s"), {static_cast<float>(left + width), baseline},
             Align::Right, kQuietText, pixel, drawing);
  return all_charts - charts.size();
}

}  // namespace contactscope::draw
