#include "draw/charts/series_chart.h"

#include "draw/charts/axis.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

constexpr double kChartHeading = 22;  // pixels at 720 lines, above the curves
constexpr double kNothing = 1e-9;     // of any unit: rounding noise around zero
constexpr double kChartHeadroom = 1.08;

/// Formats counts as in titles.
std::string plain_number(double value) {
  return value == std::round(value) ? spell_count(static_cast<std::int64_t>(value))
                                    : spell_number(value);
}

/// In the axis' unit, because successive numbers in one place should not change their unit.
std::string newest_value(const SeriesChart& chart, double value, const Prefix& prefix) {
  if (std::isnan(value)) return "none";
  if (chart.unit.empty()) return plain_number(value);
  const double scaled = value / prefix.size, size = std::abs(scaled);
  const int decimals = size >= 99.95 ? 0 : size >= 9.995 ? 1 : size < 0.0995 ? 3 : 2;
  std::string text = size < 0.0005 ? "0" : printed("%.*f", decimals, size);
  if (scaled <= -0.0005) text = "−" + text;
  const bool crowded = chart.curves.size() > 2;  // the unit is in the name
  return crowded ? text : text + " " + prefix.name + chart.unit;
}

/// Lengths below a metre are in millimetres, as usual for overlaps and margins.
Prefix axis_prefix(const std::string& unit, double largest) {
  if (unit.empty()) return {};
  return unit == "m" && largest < 1 && largest >= 1e-4 ? Prefix{1e-3, "m"} : prefix_for(largest);
}

struct ChartPen : Pen {
  const SeriesChart& chart;
  std::size_t moment;
  const Rect& rect;

  Rect area = chart_area(rect, kChartHeading, *this);
  Axis y{kChartHeadroom * chart.low, kChartHeadroom* chart.high, static_cast<float>(area.bottom()),
         static_cast<float>(area.y)};
  Prefix prefix = axis_prefix(chart.unit, std::max(chart.high, -chart.low));
  std::size_t frames = chart.curves.empty() ? 0 : chart.curves.front().size();
  bool is_wide = area.width > px(14) * static_cast<float>(frames) && frames > 40;

  void run() const {
    if (frames == 0) return;
    head();
    fill(area, with_alpha(kQuietText, 0.07f));
    tick(0);
    if (chart.high > 0) tick(round_down(chart.high));
    if (chart.low < 0) tick(-round_down(-chart.low));
    for (const SeriesChart::Change& change : chart.changes) draw_change(change);
    for (std::size_t i = 0; i < chart.curves.size(); ++i) {
      const SeriesStyle own = style(i);
      if (chart.ahead)
        curve(chart.curves[i], {with_alpha(own.color, 0.4f), own.dash}, moment, frames);
      curve(chart.curves[i], own, 0, moment + 1);
    }
    draw_moment(area, frames, moment, *this);
    for (std::size_t i = 0; i < chart.curves.size(); ++i) {
      const double newest = chart.curves[i][moment];
      if (!std::isnan(newest)) disc(place(moment, newest), 3.6, style(i).color);
    }
  }

  SeriesStyle style(std::size_t curve) const {
    return chart.total ? SeriesStyle{kText, 0} : series_style(curve);
  }

  Point2 place(std::size_t frame, double value) const {
    const double share = (static_cast<double>(frame) + 0.5) / static_cast<double>(frames);
    return pixel(area.x + area.width * share, y.at(value));
  }

  void head() const {
    const auto baseline = static_cast<float>(rect.y + px(kChartHeading - 8));
    std::string name = chart.name;
    if (!chart.unit.empty()) name += ", " + (prefix.name + chart.unit);
    // The newest values are at the right end, each in its curve's colour.
    auto right = static_cast<float>(area.right());
    for (std::size_t i = chart.curves.size(); i-- > 0;) {
      std::string value = newest_value(chart, chart.curves[i][moment], prefix);
      if (moment < chart.subjects.size() && !chart.subjects[moment].empty())
        value = chart.subjects[moment] + " " + value;
      text(value, {right, baseline}, Align::Right, style(i).color, Weight::Bold);
      right -= width_of(value, Weight::Bold) + px(10);
    }
    text(name, pixel(rect.x, baseline), Align::Left, kText);
  }

  void tick(double value) const {
    const Point2 left = pixel(area.x, y.at(value));
    const bool strong = value == 0 && chart.baseline;
    line(left, pixel(area.right(), left.y), strong ? 1.6 : 1.0, strong ? kText : kChartBorder);
    const float size = px(kChartText - 1);
    if (value != 0 && std::abs(left.y - y.at(0)) < 0.9f * size) return;  // no room next to zero
    text(value == 0 ? "0" : plain_number(value / prefix.size), left + Point2{-px(6), 0.34f * size},
         Align::Right, kQuietText);
  }

  // A thin vertical line with the states on its left and right.
  void draw_change(const SeriesChart::Change& change) const {
    if (change.frame == 0 || change.frame > moment || change.frame >= frames) return;
    const float x = 0.5f * (place(change.frame - 1, 0).x + place(change.frame, 0).x);
    const Point2 low = pixel(x, area.bottom());
    line(pixel(x, area.y), low, 1.4, kAxisText, 4);
    text(change.before, low - Point2{px(5), px(5)}, Align::Right, kAxisText);
    text(change.after, low + Point2{px(5), -px(5)}, Align::Left, kAxisText);
  }

  void curve(const std::vector<double>& values, const SeriesStyle& style, std::size_t from,
             std::size_t end) const {
    std::vector<Point2> points;
    const auto finish = [&] {
      path(points, 2.2, style.color, style.dash);
      points.clear();
    };
    for (std::size_t f = from; f < std::min(end, values.size()); ++f) {
      if (std::isnan(values[f])) {
        finish();
        continue;
      }
      const Point2 at = place(f, values[f]);
      if (chart.steps && !points.empty() && points.back().y != at.y) {
        const float middle = 0.5f * (points.back().x + at.x);
        points.push_back({middle, points.back().y});
        points.push_back({middle, at.y});
      }
      if (is_wide) disc(at, 2.4, style.color);  // each frame
      points.push_back(at);
    }
    finish();
  }
};

}  // namespace

void SeriesChart::fit() {
  low = high = 0;
  for (const std::vector<double>& curve : curves) {
    for (const double value : curve) {
      low = std::fmin(low, value);  // ignores NaN
      high = std::fmax(high, value);
    }
  }
  if (!unit.empty() && high < kNothing && low > -kNothing) low = high = 0;
  if (high == low) high = 1;  // only zeros
}

// None of these colours occurs in a view next to charts.
SeriesStyle series_style(std::size_t index) {
  constexpr std::array<SeriesStyle, 4> kStyles{
      {{kBox, 0}, {kPolytope, 8}, {kArcOfA, 2.5f}, {kMargin, 14}}};
  return kStyles[index % kStyles.size()];
}

Rect chart_area(const Rect& rect, double heading, const Pen& pen) {
  const double left = pen.px(kChartGutter), top = pen.px(heading);
  return {rect.x + left, rect.y + top, rect.width - left, rect.height - top - pen.px(4)};
}

void draw_series_chart(const SeriesChart& chart, std::size_t moment, const Rect& rect,
                       const Pen& pen) {
  ChartPen{pen, chart, moment, rect}.run();
}

void draw_series_swatch(std::size_t index, const Point2& left, double length, const Pen& pen) {
  const SeriesStyle style = series_style(index);
  pen.line(left, {left.x + pen.px(length), left.y}, 2.4, style.color, style.dash);
}

void draw_moment(const Rect& chart, std::size_t frames, std::size_t moment, const Pen& pen) {
  const double column = chart.width / static_cast<double>(frames);
  const double x = chart.x + column * (static_cast<double>(moment) + 0.5);
  const Point2 top = pixel(x, chart.y - pen.px(2)), low = pixel(x, chart.bottom() + pen.px(2));
  pen.line(top, low, 3.5, with_alpha(kWhite, 0.8f));
  pen.line(top, low, 1.5, kNormal);
}

void draw_time_axis(const std::vector<trace::Frame>& frames, double left, double width,
                    double baseline, const Pen& pen) {
  const auto at = [&](const std::string& what, double share, Align align) {
    pen.text(what, pixel(left + share * width, baseline), align, kQuietText);
  };
  // An engine may reset its clock.
  const bool rises =
      std::ranges::adjacent_find(frames, std::greater_equal(), &trace::Frame::time) == frames.end();
  const auto end = [&](const trace::Frame& frame) {
    if (!rises) return "frame " + std::to_string(frame.frame);
    return frame.time == 0 ? "0" : spell_quantity(frame.time, "s");
  };
  at(end(frames.front()), 0, Align::Left);
  at(rises ? "time" : "frames", 0.5, Align::Center);
  at(end(frames.back()), 1, Align::Right);
}

IdHistory::IdHistory(const std::vector<std::vector<IdState>>& rows,
                     const std::vector<std::size_t>& pairs)
    : frames_(rows.empty() ? 0 : rows.front().size()) {
  const auto extend = [](std::vector<Run>& runs, std::size_t f, bool changes, const Run& run) {
    if (f == 0 || changes) runs.push_back(run);
    ++runs.back().length;
  };
  std::map<std::size_t, std::vector<std::size_t>> rows_of;  // of each pair
  for (std::size_t row = 0; row < rows.size(); ++row) rows_of[pairs[row]].push_back(row);
  for (const auto& [pair, own] : rows_of) {
    std::vector<std::size_t> kept(frames_);  // points, in each frame
    std::vector<bool> replaced(frames_);     // some differ from the previous frame's
    for (const std::size_t row : own) {
      std::vector<Run>& runs = rows_.emplace_back();
      IdState before = IdState::Absent;
      for (std::size_t f = 0; f < frames_; ++f) {
        const IdState now = rows[row][f];
        extend(runs, f, now != before, {.from = f, .state = now});
        kept[f] += now == IdState::Kept;
        if ((now == IdState::Kept) != (before == IdState::Kept)) replaced[f] = true;
        before = now;
      }
    }
    std::vector<Run>& band = bands_.emplace_back();
    for (std::size_t f = 0; f < frames_; ++f)
      extend(band, f, replaced[f], {.from = f, .kept = kept[f]});
  }
}

bool IdHistory::is_constant() const {
  return std::ranges::all_of(rows_, [](const std::vector<Run>& runs) {
    return runs.size() == 1 && runs.front().state == IdState::Kept;
  });
}

Rect IdHistory::place_of(const Run& run, const Rect& strip, std::size_t until) const {
  const double column = strip.width / static_cast<double>(frames_);
  return {strip.x + column * static_cast<double>(run.from), strip.y,
          column * static_cast<double>(std::min(run.length, until - run.from)), strip.height};
}

void IdHistory::draw_rows(const Rect& strip, std::size_t moment, std::size_t until,
                          const Pen& pen) const {
  const double row = strip.height / static_cast<double>(rows_.size());
  const double gap = row > 2.5 ? 0.18 * row : 0;
  constexpr Color kThere = rgb(0xD5D8DC);
  double y = strip.y;
  for (const std::vector<Run>& runs : rows_) {
    for (const Run& run : runs) {
      if (run.from >= until) break;
      if (run.state == IdState::Absent) continue;
      const Rect place = place_of(run, strip, until);
      pen.fill({place.x, y + gap, place.width, row - 2 * gap},
               run.state == IdState::Kept ? kContact : kThere);
    }
    y += row;
  }
  draw_moment(strip, frames_, moment, pen);
}

void IdHistory::draw_bands(const Rect& strip, std::size_t moment, std::size_t count,
                           const Pen& pen) const {
  const std::size_t until = moment + 1;
  count = std::min(count, bands_.size());
  const double pitch = strip.height / static_cast<double>(count);
  const double column = strip.width / static_cast<double>(frames_);
  double top = strip.y;
  for (std::size_t b = 0; b < count; ++b, top += pitch) {
    std::size_t most = 1;
    for (const Run& run : bands_[b]) most = std::max(most, run.from < until ? run.kept : 0);
    const double low = top + 0.9 * pitch;
    std::size_t kept_before = 0;
    for (const Run& run : bands_[b]) {
      if (run.from >= until) break;
      const Rect place = place_of(run, strip, until);
      const double height = 0.8 * pitch * static_cast<double>(run.kept) / static_cast<double>(most);
      if (run.kept > 0) pen.fill({place.x, low - height, place.width, height}, kContact);
      if (run.kept > 0 && kept_before > 0)
        pen.line(pixel(place.x, low), pixel(place.x, top + 0.1 * pitch),
                 std::min(1.6, 0.5 * column / pen.px(1)), kWhite);
      kept_before = run.kept;
    }
  }
  draw_moment(strip, frames_, moment, pen);
}

}  // namespace contactscope::draw
