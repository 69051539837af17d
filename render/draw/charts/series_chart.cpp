#include "draw/charts/series_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "draw/charts/id_strip.h"
#include "draw/charts/plot_canvas.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

constexpr double kChartHeading = 22;  // pixels at 720 lines, above the curves
constexpr double kNothing = 1e-9;     // of any unit: what is left of zero by rounding
constexpr double kChartHeadroom = 1.08;

struct ValueSpan {
  double low = 0, high = 0;
};

ValueSpan span_of(const SeriesChart& chart) {
  ValueSpan span;
  for (const std::vector<double>& curve : chart.curves) {
    for (const double value : curve) {
      if (std::isnan(value)) continue;
      span.low = std::min(span.low, value);
      span.high = std::max(span.high, value);
    }
  }
  if (!chart.unit.empty() && span.high < kNothing && span.low > -kNothing) span = {};
  if (span.high == span.low) span.high = 1;  // nothing but zeros
  return span;
}

std::string plain_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", std::abs(value));
  return (value < 0 ? "−" : "") + std::string(text.data());
}

/// 1, 2, 3, 4, 5, 6 or 8 times a power of ten: the largest up to `value` > 0.
double tick_below(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {8.0, 6.0, 5.0, 4.0, 3.0, 2.0}) {
    if (step * decade <= value * (1 + 1e-9)) return step * decade;
  }
  return decade;
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
  ChartPainter(const SeriesChart& chart, std::size_t moment, const Rect& rect, float pixel,
               Drawing& drawing)
      : chart_(chart), moment_(moment), rect_(rect), pixel_(pixel), out_(drawing) {
    span_ = span_of(chart);
    const double gutter = pixel * kChartGutter, heading = pixel * kChartHeading;
    area_ = {rect.x + gutter, rect.y + heading, rect.width - gutter,
             rect.height - heading - 4 * pixel};
    frames_ = chart.curves.empty() ? 0 : chart.curves.front().size();
  }

  void run() {
    if (frames_ == 0) return;
    const Prefix prefix = axis_prefix(chart_.unit, std::max(span_.high, -span_.low));
    head(prefix);
    fill_ground();
    tick(0, "0");
    const double top = tick_below(span_.high > 0 ? span_.high : -span_.low);
    const double at = span_.high > 0 ? top : -top;
    tick(at, plain_number(at / prefix.size));
    if (span_.high > 0 && span_.low < 0) {
      const double bottom = -tick_below(-span_.low);
      tick(bottom, plain_number(bottom / prefix.size));
    }
    for (const SeriesChange& change : chart_.changes) draw_change(change);
    for (std::size_t i = 0; i < chart_.curves.size(); ++i) {
      curve(chart_.curves[i], style(i));
    }
    draw_moment(area_, frames_, moment_, pixel_, out_);
    for (std::size_t i = 0; i < chart_.curves.size(); ++i) {
      if (std::isnan(chart_.curves[i][moment_])) continue;
      out_.primitives.push_back(
          Disc{place(moment_, chart_.curves[i][moment_]), 0, 3.6f * pixel_, style(i).color});
    }
  }

 private:
  SeriesStyle style(std::size_t curve) const {
    return chart_.total ? SeriesStyle{kText, 0} : series_style(curve);
  }

  Point2 place(std::size_t frame, double value) const {
    const double x =
        area_.x + area_.width * (static_cast<double>(frame) + 0.5) / static_cast<double>(frames_);
    return {static_cast<float>(x), y_of(value)};
  }

  float y_of(double value) const {
    const double high = kChartHeadroom * span_.high, low = kChartHeadroom * span_.low;
    return static_cast<float>(area_.y + area_.height * (high - value) / (high - low));
  }

  void line(const Point2& from, const Point2& to, double width, const Color& color, float dash,
            float phase) {
    Stroke stroke{from, to, pixel_ * static_cast<float>(width), color};
    stroke.cap = dash > 0 ? Cap::Butt : Cap::Round;
    stroke.dash = pixel_ * dash;
    stroke.gap = 0.6f * stroke.dash;
    stroke.phase = phase;
    out_.primitives.push_back(stroke);
  }

  void head(const Prefix& prefix) {
    const auto baseline = static_cast<float>(rect_.y + pixel_ * (kChartHeading - 8));
    std::string name = chart_.name;
    if (!chart_.unit.empty()) name += ", " + (prefix.name + chart_.unit);
    // The newest_value values stand above the newest_value end of the axis, each in its curve's colour.
    double right = area_.x + area_.width;
    for (std::size_t i = chart_.curves.size(); i-- > 0;) {
      std::string text = newest_value(chart_, chart_.curves[i][moment_], prefix);
      if (!chart_.subject.empty()) text = chart_.subject + " " + text;
      const float size = pixel_ * static_cast<float>(kChartText);
      const double width = text_width(text, size, FontWeight::Bold);
      chart_text(text, {static_cast<float>(right), baseline}, Align::Right, style(i).color, pixel_,
                 out_, Weight::Bold);
      right -= width + 10 * pixel_;
    }
    chart_text(name, {static_cast<float>(rect_.x), baseline}, Align::Left, kText, pixel_, out_);
  }

  void fill_ground() {
    const auto x0 = static_cast<float>(area_.x), x1 = static_cast<float>(area_.x + area_.width);
    const auto y0 = static_cast<float>(area_.y), y1 = static_cast<float>(area_.y + area_.height);
    out_.primitives.push_back(
        Fill{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, with_alpha(kQuietText, 0.07f)});
  }

  void tick(double value, const std::string& text) {
    const float y = y_of(value);
    const auto left = static_cast<float>(area_.x),
               right = static_cast<float>(area_.x + area_.width);
    const bool strong = value == 0 && chart_.baseline;
    line({left, y}, {right, y}, strong ? 1.6 : 1.0, strong ? kText : kPlotBorder, 0, 0);
    const float size = pixel_ * static_cast<float>(kChartText - 1);
    if (value != 0 && std::abs(y - y_of(0)) < 0.9f * size) return;  // no room beside the zero
    chart_text(text, {left - 6 * pixel_, y + 0.34f * size}, Align::Right, kQuietText, pixel_, out_);
  }

  // A thin line across, with what was on its left and what is on its right.
  void draw_change(const SeriesChange& change) {
    if (change.frame == 0 || change.frame > moment_ || change.frame >= frames_) return;
    const float x = 0.5f * (place(change.frame - 1, 0).x + place(change.frame, 0).x);
    const auto top = static_cast<float>(area_.y),
               bottom = static_cast<float>(area_.y + area_.height);
    line({x, top}, {x, bottom}, 1.4, kAxisText, 4, 0);
    const float baseline = bottom - 5 * pixel_;
    chart_text(change.before, {x - 5 * pixel_, baseline}, Align::Right, kAxisText, pixel_, out_);
    chart_text(change.after, {x + 5 * pixel_, baseline}, Align::Left, kAxisText, pixel_, out_);
  }

  void curve(const std::vector<double>& values, const SeriesStyle& style) {
    std::vector<Point2> points;
    const auto finish = [&] {
      float run = 0;
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        line(points[i], points[i + 1], 2.2, style.color, style.dash, run);
        run += std::hypot(points[i + 1].x - points[i].x, points[i + 1].y - points[i].y);
      }
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
  float pixel_;
  Drawing& out_;
  ValueSpan span_;
  std::size_t frames_ = 0;
};

}  // namespace

SeriesStyle series_style(std::size_t index) {
  constexpr std::array<SeriesStyle, 4> kStyles{
      {{kContact, 0}, {kReferenceFace, 8}, {kText, 2.5f}, {kClipPolygon, 14}}};
  return kStyles[index % kStyles.size()];
}

void chart_text(const std::string& text, const Point2& at, Align align, const Color& color,
                float pixel, Drawing& drawing, Weight weight) {
  Text result;
  result.text = text;
  result.at = at;
  result.size = pixel * static_cast<float>(kChartText);
  result.weight = weight;
  result.align = align;
  result.color = color;
  drawing.primitives.push_back(result);
}

void draw_series_chart(const SeriesChart& chart, std::size_t moment, const Rect& rect, float pixel,
                       Drawing& drawing) {
  ChartPainter(chart, moment, rect, pixel, drawing).run();
}

}  // namespace contactscope::draw
