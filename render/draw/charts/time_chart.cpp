#include "draw/charts/time_chart.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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
constexpr double kLabelGap = 16;    // between the end of a line and its name
constexpr double kLabelRow = 17;
constexpr double kOnePlace = 14;         // ends within this distance look like one
constexpr std::size_t kMinTogether = 4;  // lines
constexpr double kFarOut = 5;            // times the others' reach: the axis leaves the line out

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

/// Moves label rows so that none overlap.
std::vector<float> spread_out(std::vector<float> wanted, float row, float top, float bottom) {
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return wanted[i]; });
  // Move crowded rows down, then back up from the bottom.
  float least = top;
  for (const std::size_t i : order) least = (wanted[i] = std::max(wanted[i], least)) + row;
  float most = bottom;
  for (auto i = order.rbegin(); i != order.rend(); ++i)
    most = (wanted[*i] = std::min(wanted[*i], most)) - row;
  return wanted;
}

struct ChartOverTime : Pen {
  const TimeChart& chart;
  const Rect& rect;

  Range range = shown_range(chart.lines);
  std::vector<std::string> labels = labels_of();
  Rect area = area_of();
  Axis x = time_axis();
  Axis y = value_axis();

  std::vector<std::string> labels_of() const {
    return mapped(chart.lines, [&](const TimeLine& line) {
      const Range own = range_of(line);
      if (own.is_in(range)) return line.name;
      const double far = own.high - range.high > range.low - own.low ? own.high : own.low;
      return line.name + ", to " + spell_quantity(far, chart.unit, 2);
    });
  }

  Rect area_of() const {
    float widest = 0;
    for (const std::string& label : labels)
      widest = std::max(widest, width_of(label, Weight::Bold));
    const double left = rect.x + px(kTicksLeft), top = rect.y + px(kNameRow);
    return {left, top, rect.right() - left - widest - px(kLabelGap + 2),
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
    draw_early_labels();
    draw_labels();
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

  Point2 end_of(std::size_t i) const {
    return place(chart.lines[i], chart.lines[i].values.size() - 1);
  }

  bool ends_early(std::size_t i) const {
    return end_of(i).x < static_cast<float>(area.right()) - px(2);
  }

  bool is_named_inside(std::size_t i) const {
    return ends_early(i) || chart.lines[i].marked.has_value();
  }

  /// Lines that end early are named at their end, marked ones at their mark.
  void draw_early_labels() const {
    std::vector<NamedLine> lines;
    for (std::size_t i = 0; i < chart.lines.size(); ++i) {
      const TimeLine& one = chart.lines[i];
      NamedLine& line = lines.emplace_back(NamedLine{labels[i], style_of(one).text, one.quiet, {}});
      for (std::size_t k = 0; k < one.values.size(); ++k) line.points.push_back(place(one, k));
      if (one.marked) line.marks.push_back({place(one, *one.marked), one.name + " " + one.mark});
    }
    std::vector<const NamedLine*> named;
    std::vector<std::vector<Point2>> anchors;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].points.empty() || !ends_early(i) || chart.lines[i].marked) continue;
      named.push_back(&lines[i]);
      const std::vector<Point2>& points = lines[i].points;
      anchors.push_back(
          {points.back(), points[points.size() * 9 / 10], points[points.size() * 3 / 4]});
    }
    name_near(named, anchors, lines, area, *this);
  }

  /// Lines by their end. Those that end within a row of each other form a group.
  std::vector<std::vector<std::size_t>> crowds() const {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < chart.lines.size(); ++i)
      if (!chart.lines[i].values.empty()) order.push_back(i);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return end_of(i).y; });
    std::vector<std::vector<std::size_t>> groups;
    for (const std::size_t i : order) {
      const bool is_near = !groups.empty() && end_of(i).x == end_of(groups.back().front()).x &&
                           end_of(i).y - end_of(groups.back().front()).y < px(kOnePlace);
      if (is_near)
        groups.back().push_back(i);
      else
        groups.push_back({i});
    }
    return groups;
  }

  std::string all_of(std::size_t count) const {
    return count == chart.lines.size() ? "all " + std::to_string(count)
                                       : "the " + std::to_string(count) + " others";
  }

  /// Many lines that end at one place cannot be distinguished there and get a single label. Quiet
  /// lines look alike anyway: each has its name, and they share a bracket and a leader.
  void draw_labels() const {
    std::vector<std::size_t> which;
    std::vector<float> wanted;
    std::vector<std::size_t> how_many;
    std::vector<std::pair<std::size_t, std::size_t>> brackets;  // first and last label of each
    for (const std::vector<std::size_t>& crowd : crowds()) {
      const bool is_quiet =
          std::ranges::all_of(crowd, [&](std::size_t i) { return chart.lines[i].quiet; });
      const bool is_large = crowd.size() >= kMinTogether;
      const bool together = is_large && !is_quiet;
      const std::size_t begin = which.size();
      for (const std::size_t i : crowd) {
        if (together && i != crowd[crowd.size() / 2]) continue;
        if (is_named_inside(i)) continue;
        which.push_back(i);
        wanted.push_back(end_of(i).y);
        how_many.push_back(together ? crowd.size() : 1);
      }
      if (is_large && is_quiet && which.size() > begin)
        brackets.emplace_back(begin, which.size() - 1);
    }
    const float row = px(kLabelRow);
    const auto top = static_cast<float>(area.y) + 0.4f * row;
    const auto bottom = static_cast<float>(area.bottom()) + px(kTicksBelow - 12);
    const std::vector<float> heights = spread_out(wanted, row, top, bottom);
    const auto left = static_cast<float>(area.right()) + px(kLabelGap);
    for (const auto& [first, last] : brackets) {
      const float before = left - px(5);
      line({before, heights[first] - px(6)}, {before, heights[last] + px(6)}, 1.2, kQuietText);
      line(end_of(which[first]), {before, heights[first]}, 1, kQuietText);
    }
    for (std::size_t k = 0; k < which.size(); ++k) {
      const TimeLine& one = chart.lines[which[k]];
      const MethodStyle style = style_of(one);
      const Point2 end = place(one, one.values.size() - 1);
      const bool is_bracketed = std::ranges::any_of(
          brackets, [&](const auto& bracket) { return bracket.first <= k && k <= bracket.second; });
      if (how_many[k] > 1) {
        line(end, {left - px(3), heights[k]}, 1, kText);
        text(all_of(how_many[k]), {left, heights[k] + px(5)}, Align::Left, kText, Weight::Bold);
        continue;
      }
      if (!is_bracketed) line(end, {left - px(3), heights[k]}, 1, style.text);
      text(labels[which[k]], {left, heights[k] + px(5)}, Align::Left, style.text, Weight::Bold);
    }
  }
};

}  // namespace

void draw_time_chart(const TimeChart& chart, const Rect& rect, const Pen& pen) {
  ChartOverTime{pen, chart, rect}.run();
}

}  // namespace contactscope::draw
