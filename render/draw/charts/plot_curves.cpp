#include "draw/charts/curve_labels.h"
#include "draw/charts/plot.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

constexpr double kLeft = 52, kFailureRow = 15;
constexpr double kZeroRow = 18;       // below a logarithmic axis, which has no zero
constexpr std::size_t kMaxTicks = 8;  // with more points the axis shows decades
constexpr double kBetweenTicks = 7;   // pixels between their labels
constexpr double kFarOut = 5;         // times the usual reach of lines: the axis leaves a line out
constexpr double kFarFromZero = 0.7;  // share of the maximum; above it zero would waste room
constexpr std::size_t kMaxWithNames = 3;  // panels; with more the lines have a legend

/// Place of the line names of a panel.
enum class Naming { None, SideLabel, Inside };

struct CurveStyle {
  Color color;
  Color text = kText;
  bool dashed = false;
  bool signal = false;
  bool quiet = false;
  int covered = 0;  // number of later series at the same places; drawn wider to stay visible

  double wider() const { return 2.0 * covered; }
  double dash() const { return dashed ? 5 : 0; }
};

/// One colour for all series whose names begin alike, equal to that of the study's other plots.
CurveStyle style_of(const trace::Study& study, const trace::StudySeries& of) {
  const std::string& method = of.method;
  const bool dashed = method.find(',') != std::string::npos && !of.look;
  if (!study.signal.empty() && method == study.signal) return {kDropped, kQuietText, true, true};
  if (of.quiet) return {kDropped, kQuietText, dashed, false, true};
  if (of.look) {
    const MethodStyle look = method_style(static_cast<std::size_t>(*of.look));
    return {look.color, look.text, dashed};
  }
  const auto stem_of = [](const std::string& name) { return name.substr(0, name.find(',')); };
  std::vector<std::string> stems;
  for (const trace::StudySeries& series : study.series) {
    const std::string stem = stem_of(series.method);
    if (series.method != study.signal && std::ranges::find(stems, stem) == stems.end())
      stems.push_back(stem);
  }
  const auto index =
      static_cast<std::size_t>(std::ranges::find(stems, stem_of(method)) - stems.begin());
  const MethodStyle look = method_style(index);
  return {look.color, look.text, dashed};
}

/// Whether the parameter increases by one from point to point.
bool counts_up(const trace::StudySeries& series) {
  const std::vector<trace::StudyPoint>& points = series.points;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].parameter != points[i - 1].parameter + 1) return false;
  return points.size() > 2;
}

/// Whether all points of both coincide.
bool covers(const trace::StudySeries& upper, const trace::StudySeries& lower) {
  return std::ranges::equal(upper.points, lower.points,
                            [](const trace::StudyPoint& a, const trace::StudyPoint& b) {
                              return a.parameter == b.parameter && a.error == b.error &&
                                     largest_error(a) == largest_error(b);
                            });
}

bool has_zero(const PlotPanel& panel) {
  return std::ranges::any_of(panel.series, [](const trace::StudySeries* series) {
    return std::ranges::any_of(series->points, [](const trace::StudyPoint& point) {
      return point.error && largest_error(point) == 0;
    });
  });
}

bool has_failures(const trace::StudySeries& series) {
  return std::ranges::any_of(series.points, [](const auto& point) { return point.failed > 0; });
}

/// Maximum number of series with failures in a panel.
int failing_series(const std::vector<PlotPanel>& panels) {
  std::ptrdiff_t most = 0;
  for (const PlotPanel& panel : panels)
    most = std::max(most, std::ranges::count_if(panel.series, [](const auto* series) {
                      return has_failures(*series);
                    }));
  return static_cast<int>(most);
}

/// Names at the ends of lines would be ambiguous if several end at zero.
bool several_end_at_zero(const std::vector<PlotPanel>& panels) {
  return std::ranges::any_of(panels, [](const PlotPanel& panel) {
    return std::ranges::count_if(panel.series, [](const trace::StudySeries* series) {
             return !series->points.empty() && series->points.back().error &&
                    largest_error(series->points.back()) == 0;
           }) > 1;
  });
}

bool same_lines(const std::vector<PlotPanel>& panels) {
  return std::ranges::all_of(panels, [&](const PlotPanel& panel) {
    return std::ranges::equal(panel.series, panels.front().series, {}, &trace::StudySeries::method,
                              &trace::StudySeries::method);
  });
}

/// Tick format of errors on a linear axis from zero.
struct LinearUnit {
  const char* unit;
  double factor;
  const char* suffix;
};
constexpr std::array<LinearUnit, 4> kLinearUnits = {{{trace::kShare, 100, " %"},
                                                     {trace::kTimes, 1, " ×"},
                                                     {trace::kSum, 1, " ms"},
                                                     {trace::kMicroseconds, 1, " µs"}}};

/// None for a logarithmic axis.
std::optional<LinearUnit> linear_unit(const trace::Study& study) {
  const auto found = std::ranges::find_if(
      kLinearUnits, [&](const LinearUnit& one) { return study.unit == one.unit; });
  return found == kLinearUnits.end() ? std::nullopt : std::optional(*found);
}

struct Curves : Pen {
  const trace::Study& study;
  PositiveRange errors;  // of all panels
  double least_error;    // zero included
  int failure_rows;
  bool has_zero_row;
  std::optional<LinearUnit> linear;
  bool is_over_time = false;  // a linear axis of seconds; a failure is the end of a line

  /// The parameters of a panel, if ticks at each of them have room and short names; otherwise none.
  std::vector<double> ticks_at_points(const PlotPanel& panel, const Axis& x) const {
    std::set<double> values;
    for (const trace::StudySeries* series : panel.series)
      for (const trace::StudyPoint& point : series->points) values.insert(point.parameter);
    if (values.size() > kMaxTicks) return {};
    float free = -1e9f;
    for (const double value : values) {
      const double decade = std::round(std::log10(value));
      const bool is_decade = std::abs(std::log10(value) - decade) < 1e-9;
      const bool is_short =
          value > 0.9e-3 && value < 1e4 && std::stod(printed("%.3g", value)) == value;
      const float half = 0.5f * width_of(spell_tick_error(value, ""));
      if (!(is_decade || is_short) || x.at(value) - half < free) return {};
      free = x.at(value) + half + px(kBetweenTicks);
    }
    return {values.begin(), values.end()};
  }

  double top_of_axis() const { return errors.high + 0.04 * (errors.high - bottom_of_axis()); }
  /// Zero, unless some values are negative, or all far from it: then a whole step below the least.
  double bottom_of_axis() const {
    if (least_error < 0) return least_error - 0.04 * (errors.high - least_error);
    if (least_error < kFarFromZero * errors.high) return 0;
    const double step = round_up((errors.high - least_error) / 6);
    return step * std::floor(least_error / step - 0.5);
  }

  /// Legend with names of lines if these are not named in the panels, and with failures.
  void legend(Point2 at, bool names) const {
    std::set<std::string> record;
    const auto name = [&](const std::string& what) {
      text(what, at + Point2{px(36), px(5)}, Align::Left, kText);
      at.x += px(36) + width_of(what) + px(26);
    };
    for (const trace::StudySeries& series : study.series) {
      if (!names || series.method == study.signal || !record.insert(series.method).second) continue;
      const CurveStyle style = style_of(study, series);
      line(at, {at.x + px(30), at.y}, 2.5, style.color, style.dash());
      marker({at.x + px(15), at.y}, style);
      name(series.method);
    }
    if (failure_rows == 0) return;
    const auto failing = std::ranges::find_if(study.series, has_failures);
    cross({at.x + px(15), at.y}, 4, 1.8, style_of(study, *failing).color);
    name("failures, of all cases");
  }

  void panel(const PlotPanel& panel, Naming naming, bool names_signal) const {
    PositiveRange parameters;
    bool counts = true;
    for (const trace::StudySeries* series : panel.series) {
      for (const trace::StudyPoint& point : series->points) parameters.include(point.parameter);
      counts = counts && counts_up(*series);
    }
    const Rect& area = panel.area;
    const auto left = static_cast<float>(area.x), right = static_cast<float>(area.right());
    const auto above = static_cast<float>(area.y), bottom = static_cast<float>(area.bottom());
    // All panels have equal room for these rows, so that one height means one error everywhere.
    const float top = above + px(failure_rows * kFailureRow + 4);
    const Axis x = is_over_time ? Axis{0, parameters.high, left, right}
                   : counts     ? Axis{parameters.low, parameters.high, left + px(8), right - px(8)}
                                : parameters.axis(left, right, px(8), px(8));
    const float floor = has_zero_row ? bottom - px(kZeroRow) : bottom;
    const Axis y = linear ? Axis{bottom_of_axis(), top_of_axis(), bottom, top}
                          : errors.axis(floor, top, px(6), px(failure_rows > 0 ? 20 : 6));
    const auto place = [&](const trace::StudyPoint& point) {
      const double error = largest_error(point);
      return Point2{x.at(point.parameter),
                    has_zero_row && error == 0 ? 0.5f * (floor + bottom) : y.at(error)};
    };
    draw_decades_along(x, area, true, *this,
                       is_over_time ? x.multiples_of(round_up(px(56) * x.high / (right - left)))
                       : counts     ? std::vector<double>{}
                                    : ticks_at_points(panel, x));
    if (linear)
      draw_linear_up(y, area, linear->factor, linear->suffix, panel.begins_row, *this);
    else
      draw_decades_up(y, area, true, panel.begins_row, *this);
    frame(area, 1.2, kChartBorder);
    // Lines separate failures and zeros from the values.
    if (failure_rows > 0) line({left, top - px(1)}, {right, top - px(1)}, 1.2, kChartBorder);
    if (has_zero_row) line({left, floor}, {right, floor}, 1.2, kChartBorder);
    text(panel.name, {left, above - px(6)}, Align::Left, kText, Weight::Bold);
    text(fitted(panel.parameter, Weight::Regular, right - left), {right, bottom + px(34)},
         Align::Right, kQuietText);
    for (const bool behind : {true, false}) {
      for (std::size_t i = 0; i < panel.series.size(); ++i) {
        CurveStyle style = style_of(study, *panel.series[i]);
        if ((style.signal || style.quiet) != behind) continue;
        for (std::size_t later = i + 1; later < panel.series.size(); ++later)
          style.covered += covers(*panel.series[later], *panel.series[i]) ? 1 : 0;
        curve(*panel.series[i], style, place);
      }
    }
    if (panel.begins_row && has_zero_row)
      text("0", {left - px(8), 0.5f * (floor + bottom) + px(5)}, Align::Right, kQuietText);
    std::vector<NamedLine> lines = named_lines(panel);
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (const trace::StudyPoint& point : panel.series[i]->points)
        if (point.error) {
          lines[i].points.push_back(place(point));
          if (!point.mark.empty()) lines[i].marks.push_back({place(point), point.mark});
        }
    const Rect values{area.x, top, area.width, bottom - top};
    if (naming == Naming::None) name_near({}, {}, lines, values, *this);
    if (names_signal) name_signal(panel, x, y);
    if (naming == Naming::SideLabel) name_at_side(lines, values, *this);
    if (naming == Naming::Inside) name_inside(lines, values, *this);
    if (is_over_time) return;
    float row = above + px(2 + 0.5 * kFailureRow);
    for (const trace::StudySeries* series : panel.series)
      if (failures(*series, x, left, right, row)) row += px(kFailureRow);
  }

  /// The signal has no marker for a legend.
  void name_signal(const PlotPanel& panel, const Axis& x, const Axis& y) const {
    for (const trace::StudySeries* series : panel.series) {
      if (series->method != study.signal || series->points.empty()) continue;
      const trace::StudyPoint& last = series->points.back();
      text(series->method, {x.at(last.parameter), y.at(largest_error(last)) - px(6)}, Align::Right,
           kQuietText, Weight::Regular, 0, 2);
    }
  }

  /// The named lines without points, which follow later.
  std::vector<NamedLine> named_lines(const PlotPanel& panel) const {
    std::vector<NamedLine> lines;
    for (const trace::StudySeries* series : panel.series) {
      const CurveStyle style = style_of(study, *series);
      lines.push_back({series->method, style.text, style.quiet || style.signal, {}});
    }
    return lines;
  }

  void marker(const Point2& at, const CurveStyle& style) const {
    draw_marker(Marker::Circle, at, px((style.quiet ? 2.4 : 3.4) + style.wider()), style.color,
                drawing());
    if (style.dashed) draw_marker(Marker::Circle, at, px(1.9), kWhite, drawing());
  }

  /// Dashed towards a zero that is below the axis.
  template <class Place>
  void curve(const trace::StudySeries& series, const CurveStyle& style, const Place& place) const {
    const double width = style.signal || style.quiet ? 1.5 : 2.2 + style.wider();
    if (is_over_time) path(mapped(series.points, place), width, style.color);
    for (std::size_t i = 1; i < series.points.size() && !is_over_time; ++i) {
      const trace::StudyPoint &before = series.points[i - 1], &point = series.points[i];
      if (!before.error || !point.error) continue;
      const bool leaves_axis =
          has_zero_row && (largest_error(before) == 0) != (largest_error(point) == 0);
      line(place(before), place(point), width, style.color, leaves_axis ? 3 : style.dash());
    }
    if (style.signal) return;
    for (const trace::StudyPoint& point : series.points) {
      if (is_over_time && point.failed > 0) cross(place(point), 5, 2.4, style.color);
      if (point.error && !is_over_time) marker(place(point), style);
    }
  }

  /// Text before each cross; for the first "64 samples: 1 of 200 hits missed". Empty without room.
  std::vector<std::string> failures_of_each(const trace::StudySeries& series, const Axis& x,
                                            float left) const {
    std::vector<std::string> words;
    for (const trace::StudyPoint& point : series.points) {
      if (point.failed == 0) continue;
      const std::string count = spell_count(point.failed) + " of " + spell_count(point.of);
      words.push_back(words.empty() ? name_before_colon(series) + ": " + count + " " + study.failed
                                    : count);
      const float at = x.at(point.parameter);
      if (at - px(20) - width_of(words.back()) < left) return {};
      left = at;
    }
    return words;
  }

  static std::string name_before_colon(const trace::StudySeries& series) {
    return series.method.substr(0, series.method.find(':'));
  }

  /// Crosses, and their count at the end with fewer of them. False if there are none.
  bool failures(const trace::StudySeries& series, const Axis& x, float left, float right,
                float row) const {
    int on_the_left = 0, crosses = 0;
    float first = right;
    std::vector<std::string> each;
    if (!study.failed.empty()) each = failures_of_each(series, x, left);
    for (const trace::StudyPoint& point : series.points) {
      if (point.failed == 0) continue;
      const float at = x.at(point.parameter);
      const CurveStyle style = style_of(study, series);
      cross({at, row}, 3.6, 1.8, style.color);
      if (!each.empty())
        text(contactscope::at(each, crosses), {at - px(10), row + px(5)}, Align::Right, style.text);
      ++crosses;
      first = std::min(first, at);
      on_the_left += at < 0.5f * (left + right);
    }
    if (crosses == 0) return false;
    if (!each.empty()) return true;
    if (!study.failed.empty()) {
      // Total as text, before the first cross if there is room, otherwise after the last.
      const std::string words =
          name_before_colon(series) + ": " + spell_failures(series) + " " + study.failed;
      const bool fits = first - px(10) - width_of(words) > left;
      text(words, {fits ? first - px(10) : right - px(6), row + px(5)}, Align::Right,
           style_of(study, series).text);
      return true;
    }
    const bool at_left = 2 * on_the_left < crosses;
    const Point2 place{at_left ? left + px(6) : right - px(6), row + px(5)};
    const Align align = at_left ? Align::Left : Align::Right;
    text(spell_failures(series), place, align, kQuietText);
    return true;
  }
};

}  // namespace

Drawing plot_curves(const trace::Study& study, int width, int height) {
  const auto points = points_of(study);
  // Quantities with a single value per point, such as a time or a share, have no largest one.
  const bool has_worst = std::ranges::any_of(points, [](const trace::StudyPoint& p) {
    return p.error && p.error_worst && *p.error_worst > *p.error;
  });
  std::string shown = study.shown.empty() ? study.error : study.shown;
  if (study.shown.empty() && has_worst) shown = "Largest " + shown;
  if (study.shown.empty() && !study.unit.empty() && study.unit != trace::kShare &&
      study.unit != trace::kTimes)
    shown += ", " + study.unit;
  if (!shown.empty())
    shown[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(shown[0])));
  const std::vector<PlotPanel> all = panels_of(study);
  const int failure_rows = failing_series(all);
  const Naming naming = all.size() > kMaxWithNames ? Naming::None
                        : several_end_at_zero(all) ? Naming::Inside
                                                   : Naming::SideLabel;
  const bool has_legend = naming == Naming::None || (failure_rows > 0 && study.failed.empty());
  PlotPage page = plot_page(study, shown, has_legend, width, height);
  PositiveRange errors;
  double least = std::numeric_limits<double>::infinity();
  for (const trace::StudyPoint& point : points) {
    errors.include(largest_error(point));
    if (point.error) least = std::min(least, largest_error(point));
  }
  if (errors.high == 0) errors = {1e-16, 1};
  const bool has_zero_row = !linear_unit(study) && std::ranges::any_of(all, has_zero);
  const Pen writing(page.drawing, page.scale, kPlotText);
  Curves curves{writing, study, errors, least, failure_rows, has_zero_row, linear_unit(study)};
  if (has_legend) curves.legend(page.legend, naming == Naming::None);
  // If all panels have the same lines, they are named once.
  const bool once = all.size() > 1 && same_lines(all);
  const auto room = [&](const PlotPanel& panel) {
    return naming == Naming::SideLabel ? side_room(curves.named_lines(panel), curves) : 0;
  };
  if (once) page.panels.width -= room(all.back());
  std::vector<PlotPanel> panels = panels_on(page, study, kLeft);
  const PlotPanel& named = naming == Naming::SideLabel ? panels.back() : panels.front();
  for (PlotPanel& panel : panels) {
    if (!once) panel.area.width -= room(panel);
    const bool is_first = &panel == &panels.front();
    curves.panel(panel, once && &panel != &named ? Naming::None : naming,
                 is_first && naming == Naming::None);
  }
  return page.drawing;
}

void draw_over_time(trace::Study study, const Rect& rect, const Pen& pen) {
  const auto reach = [](const trace::StudySeries& line) {
    double most = 0;
    for (const trace::StudyPoint& point : line.points)
      most = std::max(most, std::abs(*point.error));
    return most;
  };
  std::vector<double> reaches = mapped(study.series, reach);
  std::ranges::sort(reaches);
  const double usual = reaches[(reaches.size() - 1) / 2];
  PositiveRange values;
  double least = std::numeric_limits<double>::infinity();
  for (trace::StudySeries& line : study.series) {
    const bool is_far = usual > 0 && reach(line) > kFarOut * usual;
    if (is_far && !line.method.empty())
      line.method += ", to " + spell_quantity(reach(line), study.unit, 2);
    for (const trace::StudyPoint& point : line.points) {
      if (is_far) break;
      values.include(*point.error);
      least = std::min(least, *point.error);
    }
  }
  const double largest = std::max(values.high, -least);
  if (!(largest > 0)) values.high = 1;
  const bool is_small_length = study.unit == "m" && largest < 1;
  const Prefix prefix = is_small_length ? Prefix{1e-3, "m"} : prefix_for(largest);
  PlotPanel panel = panels_of(study).front();
  panel.name = study.error + ", " + prefix.name + study.unit;
  panel.parameter = "time, s";
  panel.begins_row = true;
  const Curves curves{pen, study, values, least, 0, false, LinearUnit{"", 1 / prefix.size, ""},
                      true};
  panel.area = {rect.x + pen.px(kLeft), rect.y + pen.px(24),
                rect.width - pen.px(kLeft) - side_room(curves.named_lines(panel), curves),
                rect.height - pen.px(62)};
  curves.panel(panel, Naming::SideLabel, false);
}

}  // namespace contactscope::draw
