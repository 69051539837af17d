#include "draw/charts/series_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "draw/charts/axis.h"
#include "draw/charts/id_strip.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/sequence_scales.h"

namespace contactscope::draw {
namespace {

constexpr double kChartHeading = 22;  // pixels at 720 lines, above the curves
constexpr double kNothing = 1e-9;     // of any unit: what is left of zero by rounding
constexpr double kChartHeadroom = 1.08;

std::string plain_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", std::abs(value));
  return (value < 0 ? "−" : "") + std::string(text.data());
}

/// In the axis' unit: numbers that follow each other in one place should not change theirs.
std::string newest_value(const SeriesChart& chart, double value, const Prefix& prefix) {
  if (std::isnan(value)) return "none";
  const bool crowded = chart.curves.size() > 2;  // the unit stands in the name
  if (chart.unit.empty()) return plain_number(value);
  const double scaled = value / prefix.size;
  std::array<char, 32> text{};
  if (std::abs(scaled) < 0.0005) {
    std::snprintf(text.data(), text.size(), "%s", "0");
  } else {
    const int decimals = std::abs(scaled) >= 99.95 ? 0 : std::abs(scaled) >= 9.995 ? 1 : 2;
    std::snprintf(text.data(), text.size(), "%.*f", std::abs(scaled) < 0.0995 ? 3 : decimals,
                  std::abs(scaled));
  }
  const std::string spelled = (scaled <= -0.0005 ? "−" : "") + std::string(text.data());
  return crowded ? spelled : spelled + " " + prefix.name + chart.unit;
}

/// Lengths below a metre are millimetres, as overlaps and margins are spoken of.
Prefix axis_prefix(const std::string& unit, double largest) {
  if (unit.empty()) return {};
  return unit == "m" && largest < 1 && largest >= 1e-4 ? Prefix{1e-3, "m"} : prefix_for(largest);
}

class ChartPainter {
 public:
  ChartPainter(const SeriesChart& chart, std::size_t moment, const Rect& rect, const Pen& pen)
      : chart_(chart), moment_(moment), rect_(rect), area_(area_in(rect, pen)), pen_(pen) {
    frames_ = chart.curves.empty() ? 0 : chart.curves.front().size();
    y_ = Axis::linear(kChartHeadroom * chart.low, kChartHeadroom * chart.high,
                      static_cast<float>(area_.y + area_.height), static_cast<float>(area_.y));
    prefix_ = axis_prefix(chart.unit, std::max(chart.high, -chart.low));
  }

  void run() {
    if (frames_ == 0) return;
    head();
    pen_.fill(area_, with_alpha(kQuietText, 0.07f));
    tick(0);
    if (chart_.high > 0) tick(round_down(chart_.high));
    if (chart_.low < 0) tick(-round_down(-chart_.low));
    for (const SeriesChange& change : chart_.changes) draw_change(change);
    for (std::size_t i = 0; i < chart_.curves.size(); ++i) curve(chart_.curves[i], style(i));
    draw_moment(area_, frames_, moment_, pen_);
    for (std::size_t i = 0; i < chart_.curves.size(); ++i) {
      const double newest = chart_.curves[i][moment_];
      if (!std::isnan(newest)) pen_.disc(place(moment_, newest), 3.6, style(i).color);
    }
  }

 private:
  static Rect area_in(const Rect& rect, const Pen& pen) {
    const double gutter = pen.px(kChartGutter), heading = pen.px(kChartHeading);
    return {rect.x + gutter, rect.y + heading, rect.width - gutter,
            rect.height - heading - pen.px(4)};
  }

  SeriesStyle style(std::size_t curve) const {
    return chart_.total ? SeriesStyle{kText, 0} : series_style(curve);
  }

  Point2 place(std::size_t frame, double value) const {
    const double share = (static_cast<double>(frame) + 0.5) / static_cast<double>(frames_);
    return {static_cast<float>(area_.x + area_.width * share), y_.at(value)};
  }

  void head() {
    const auto baseline = static_cast<float>(rect_.y + pen_.px(kChartHeading - 8));
    std::string name = chart_.name;
    if (!chart_.unit.empty()) name += ", " + (prefix_.name + chart_.unit);
    // The newest values stand above the newest end of the axis, each in its curve's colour.
    auto right = static_cast<float>(area_.x + area_.width);
    for (std::size_t i = chart_.curves.size(); i-- > 0;) {
      std::string text = newest_value(chart_, chart_.curves[i][moment_], prefix_);
      if (moment_ < chart_.subjects.size() && !chart_.subjects[moment_].empty())
        text = chart_.subjects[moment_] + " " + text;
      pen_.text(text, {right, baseline}, Align::Right, style(i).color, Weight::Bold);
      right -= pen_.width_of(text, Weight::Bold) + pen_.px(10);
    }
    pen_.text(name, {static_cast<float>(rect_.x), baseline}, Align::Left, kText);
  }

  void tick(double value) {
    const float y = y_.at(value);
    const auto left = static_cast<float>(area_.x);
    const bool strong = value == 0 && chart_.baseline;
    pen_.line({left, y}, {static_cast<float>(area_.x + area_.width), y}, strong ? 1.6 : 1.0,
              strong ? kText : kChartBorder);
    const float size = pen_.px(kChartText - 1);
    if (value != 0 && std::abs(y - y_.at(0)) < 0.9f * size) return;  // no room beside the zero
    pen_.text(value == 0 ? "0" : plain_number(value / prefix_.size),
              {left - pen_.px(6), y + 0.34f * size}, Align::Right, kQuietText);
  }

  // A thin line across, with what was on its left and what is on its right.
  void draw_change(const SeriesChange& change) {
    if (change.frame == 0 || change.frame > moment_ || change.frame >= frames_) return;
    const float x = 0.5f * (place(change.frame - 1, 0).x + place(change.frame, 0).x);
    const auto bottom = static_cast<float>(area_.y + area_.height);
    pen_.line({x, static_cast<float>(area_.y)}, {x, bottom}, 1.4, kAxisText, 4);
    const float baseline = bottom - pen_.px(5);
    pen_.text(change.before, {x - pen_.px(5), baseline}, Align::Right, kAxisText);
    pen_.text(change.after, {x + pen_.px(5), baseline}, Align::Left, kAxisText);
  }

  void curve(const std::vector<double>& values, const SeriesStyle& style) {
    std::vector<Point2> points;
    const auto finish = [&] {
      pen_.path(points, 2.2, style.color, style.dash);
      points.clear();
    };
    for (std::size_t f = 0; f <= moment_ && f < values.size(); ++f) {
      if (std::isnan(values[f])) {
        finish();
        continue;
      }
      const Point2 at = place(f, values[f]);
      if (chart_.steps && !points.empty() && points.back().y != at.y) {
        const float middle = 0.5f * (points.back().x + at.x);
        points.push_back({middle, points.back().y});
        points.push_back({middle, at.y});
      }
      points.push_back(at);
    }
    finish();
  }

  const SeriesChart& chart_;
  std::size_t moment_;
  Rect rect_, area_;
  Pen pen_;
  Axis y_;
  Prefix prefix_;
  std::size_t frames_ = 0;
};

}  // namespace

void SeriesChart::fit() {
  low = high = 0;
  for (const std::vector<double>& curve : curves) {
    for (const double value : curve) {
      if (std::isnan(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (!unit.empty() && high < kNothing && low > -kNothing) low = high = 0;
  if (high == low) high = 1;  // nothing but zeros
}

SeriesStyle series_style(std::size_t index) {
  constexpr std::array<SeriesStyle, 4> kStyles{
      {{kContact, 0}, {kReferenceFace, 8}, {kText, 2.5f}, {kClipPolygon, 14}}};
  return kStyles[index % kStyles.size()];
}

void draw_series_chart(const SeriesChart& chart, std::size_t moment, const Rect& rect,
                       const Pen& pen) {
  ChartPainter(chart, moment, rect, pen).run();
}

void draw_series_swatch(std::size_t index, const Point2& left, double length, const Pen& pen) {
  const SeriesStyle style = series_style(index);
  pen.line(left, {left.x + pen.px(length), left.y}, 2.4, style.color, style.dash);
}

void draw_time_axis(double duration, double left, double width, double baseline, const Pen& pen) {
  const auto at = [&](const std::string& what, double share, Align align) {
    pen.text(what, {static_cast<float>(left + share * width), static_cast<float>(baseline)}, align,
             kQuietText);
  };
  at("0", 0, Align::Left);
  at("time", 0.5, Align::Center);
  at(spell_quantity(duration, "s"), 1, Align::Right);
}

}  // namespace contactscope::draw
