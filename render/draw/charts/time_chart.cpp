#include "draw/charts/time_chart.h"

#include <algorithm>
#include <cmath>

#include "core/at.h"
#include "draw/charts/curve_labels.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kNameRow = 24;  // above the lines
constexpr double kTicksLeft = 46;
constexpr double kTicksBelow = 38;  // including the axis' name
constexpr double kFarOut = 5;       // times the others' reach: the axis leaves the line out

struct Range {
  double low = 0, high = 0;

  double span() const { return high - low; }
  bool is_in(const Range& other) const { return low >= other.low && high <= other.high; }
};

Range range_of(const TimeLine& line) {
  if (line.values.empty()) return {};
  const auto [low, high] = std::ranges::minmax(line.values);
  return {low, high};
}

/// Range of all lines, with zero unless all are far from it. Lines that reach too far are excluded,
/// because the others would coincide.
Range shown_range(const std::vector<TimeLine>& lines) {
  std::vector<Range> ranges;
  for (const TimeLine& line : lines)
    if (!line.values.empty()) ranges.push_back(range_of(line));
  if (ranges.empty()) return {0, 1};
  const auto reach = [](const Range& range) { return std::max(range.high, -range.low); };
  std::ranges::sort(ranges, {}, reach);
  Range all;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const bool is_first_half = 2 * i < ranges.size() + 1;
    const double so_far = std::max(all.high, -all.low);
    if (!is_first_half && reach(ranges[i]) > kFarOut * so_far && so_far > 0) break;
    all.low = std::min(all.low, ranges[i].low);
    all.high = std::max(all.high, ranges[i].high);
  }
  if (all.span() == 0) all.high = 1;
  double least = all.high;
  for (const Range& range : ranges) least = std::min(least, range.low);
  constexpr double kFarFromZero = 0.7;  // share of the maximum: zero would waste most of the room
  if (least > kFarFromZero * all.high) all.low = least;
  return all;
}

/// Round numbers between two values, at most `most` of them.
std::vector<double> round_ticks(double low, double high, int most) {
  double step = round_down((high - low) / most);
  while (std::floor(high / step) - std::ceil(low / step) + 1 > most)
    step = round_down(2.6 * step);  // 1, 2, 5, 10
  std::vector<double> ticks;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    ticks.push_back(i == 0 ? 0 : i * step);  // not -0
  return ticks;
}

struct ChartOverTime : Pen {
  const TimeChart& chart;
  const Rect& rect;

  Range range = shown_range(chart.lines);
  std::vector<NamedLine> names = mapped(chart.lines, [&](const auto& one) { return named(one); });
  Rect area = area_of();
  Axis x = time_axis();
  Axis y = value_axis();

  /// The name of a line, without its points. A marked line is named at its mark.
  NamedLine named(const TimeLine& line) const {
    const Range own = range_of(line);
    std::string name = line.marked ? "" : line.name;
    if (!name.empty() && !own.is_in(range)) {
      const double far = own.high - range.high > range.low - own.low ? own.high : own.low;
      name += ", to " + spell_quantity(far, chart.unit, 2);
    }
    return {name, style_of(line).text, line.quiet, {}};
  }

  Rect area_of() const {
    const double left = rect.x + px(kTicksLeft), top = rect.y + px(kNameRow);
    return {left, top, rect.right() - left - side_room(names, *this),
            rect.bottom() - px(kTicksBelow) - top};
  }

  Axis time_axis() const {
    double last = 0;
    for (const TimeLine& line : chart.lines)
      if (!line.time.empty()) last = std::max(last, line.time.back());
    return {0, last > 0 ? last : 1, static_cast<float>(area.x), static_cast<float>(area.right())};
  }

  Axis value_axis() const {
    const double room = 0.06 * range.span();
    return {range.low - (range.low == 0 ? 0 : room), range.high + room,
            static_cast<float>(area.bottom()), static_cast<float>(area.y)};
  }

  void run() const {
    draw_ticks();
    frame(area, 1.2, kChartBorder);
    // The first line last, so that the others do not hide it.
    for (const bool quiet : {true, false})
      for (std::size_t i = chart.lines.size(); i-- > 0;)
        if (chart.lines[i].quiet == quiet) draw_line(chart.lines[i]);
    draw_names();
  }

  void draw_ticks() const {
    const double largest = std::max(range.high, -range.low);
    const bool is_small_length = chart.unit == "m" && largest < 1;
    const Prefix prefix = is_small_length ? Prefix{1e-3, "m"} : prefix_for(largest);
    text(chart.name + ", " + prefix.name + chart.unit, pixel(area.x, area.y - px(8)), Align::Left,
         kText, Weight::Bold);
    const auto rows = std::max(2, static_cast<int>(area.height / px(34)));
    const std::vector<double> values = round_ticks(y.low, y.high, rows);
    // If the axis does not begin at zero, use as many digits as distinguish neighbouring ticks.
    const double step = values.size() > 1 ? values[1] - values[0] : 1;
    const int digits = std::max(4, static_cast<int>(std::ceil(std::log10(largest / step))) + 1);
    for (const double value : values) {
      const Point2 left = pixel(area.x, y.at(value));
      line(left, pixel(area.right(), left.y), value == 0 ? 1.4 : 1,
           value == 0 ? kChartBorder : kChartGrid);
      text(spell_number(value / prefix.size, digits), left + Point2{-px(6), px(5)}, Align::Right,
           kQuietText);
    }
    const auto columns = std::max(2, static_cast<int>(area.width / px(56)));
    for (const double value : round_ticks(0, x.high, columns)) {
      const Point2 foot = pixel(x.at(value), area.bottom());
      line(pixel(foot.x, area.y), foot, 1, kChartGrid);
      text(spell_number(value), foot + Point2{0, px(17)}, Align::Center, kQuietText);
    }
    text("time, s", pixel(area.right(), area.bottom() + px(34)), Align::Right, kQuietText);
  }

  Point2 place(const TimeLine& one, std::size_t i) const {
    return {x.at(one.time[i]), y.at(one.values[i])};
  }

  static MethodStyle style_of(const TimeLine& one) {
    return one.quiet ? MethodStyle{kDropped, kQuietText} : method_style(one.style);
  }

  void draw_line(const TimeLine& one) const {
    const MethodStyle style = style_of(one);
    std::vector<Point2> points;
    for (std::size_t i = 0; i < one.values.size(); ++i) points.push_back(place(one, i));
    path(points, one.quiet ? 1.5 : 2.2, style.color, style.dash, style.gap);
    if (one.breaks_off && !points.empty()) cross(points.back(), 5, 2.4, style.color);
  }

  void draw_names() const {
    std::vector<NamedLine> lines = names;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const TimeLine& one = chart.lines[i];
      for (std::size_t k = 0; k < one.values.size(); ++k) lines[i].points.push_back(place(one, k));
      if (one.marked)
        lines[i].marks.push_back({place(one, *one.marked), one.name + " " + one.mark});
    }
    name_at_side(lines, area, *this);
  }
};

}  // namespace

void draw_time_chart(const TimeChart& chart, const Rect& rect, const Pen& pen) {
  ChartOverTime{pen, chart, rect}.run();
}

}  // namespace contactscope::draw
