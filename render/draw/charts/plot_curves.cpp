#include <algorithm>
#include <cctype>
#include <set>

#include "draw/charts/plot.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

constexpr double kLeft = 52;
constexpr double kFailureRow = 15;
constexpr int kFailureRows = 4;

struct CurveStyle {
  Color color;
  bool dashed = false;
  bool signal = false;
  int covered =
      0;  // by so many later ones at the same places: it is drawn wider, to be seen beside them

  double wider() const { return 2.0 * covered; }
  double dash() const { return dashed ? 5 : 0; }
};

/// One colour for all series whose names begin alike: that which the study's other plots give the
/// method of that number.
CurveStyle style_of(const trace::Study& study, const std::string& method) {
  if (method == study.signal) return {kDropped, true, true};
  const auto stem_of = [](const std::string& name) { return name.substr(0, name.find(',')); };
  std::vector<std::string> stems;
  for (const trace::StudySeries& series : study.series) {
    const std::string stem = stem_of(series.method);
    if (series.method != study.signal && std::ranges::find(stems, stem) == stems.end())
      stems.push_back(stem);
  }
  const auto index =
      static_cast<std::size_t>(std::ranges::find(stems, stem_of(method)) - stems.begin());
  return {method_style(index).color, method.find(',') != std::string::npos, false};
}

/// The parameter goes up by one from point to point.
bool counts_up(const trace::StudySeries& series) {
  const std::vector<trace::StudyPoint>& points = series.points;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].parameter != points[i - 1].parameter + 1) return false;
  return points.size() > 2;
}

/// All points of both are at the same places.
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

struct Curves : Pen {
  const trace::Study& study;
  PositiveRange errors;  // of all panels
  bool any_failed;

  void legend(Point2 at) const {
    std::set<std::string> told;
    const auto name = [&](const std::string& what) {
      text(what, at + Point2{px(36), px(5)}, Align::Left, kText);
      at.x += px(36) + width_of(what) + px(26);
    };
    for (const trace::StudySeries& series : study.series) {
      if (!told.insert(series.method).second) continue;
      const CurveStyle style = style_of(study, series.method);
      line(at, {at.x + px(30), at.y}, style.signal ? 1.5 : 2.5, style.color, style.dash());
      if (!style.signal) marker({at.x + px(15), at.y}, style);
      name(series.method);
    }
    if (!any_failed) return;
    cross({at.x + px(15), at.y}, 4, 1.8, kText);
    name("failures, of all cases");
  }

  void panel(const PlotPanel& panel) const {
    PositiveRange parameters;
    bool counts = true;
    for (const trace::StudySeries* series : panel.series) {
      for (const trace::StudyPoint& point : series->points) parameters.include(point.parameter);
      counts = counts && counts_up(*series);
    }
    const Rect& area = panel.area;
    const auto left = static_cast<float>(area.x), right = static_cast<float>(area.right());
    const auto above = static_cast<float>(area.y), bottom = static_cast<float>(area.bottom());
    // Room for the rows of all panels alike, so that one height means one error everywhere.
    const float top = above + px((any_failed ? kFailureRows : 0) * kFailureRow + 4);
    const Axis x = counts ? Axis{parameters.low, parameters.high, left + px(8), right - px(8)}
                          : parameters.axis(left, right, px(8), px(8));
    const Axis y = errors.axis(bottom, top, px(6), px(6));
    draw_decades_along(x, area, true, *this);
    draw_decades_up(y, area, true, panel.begins_row, *this);
    frame(area, 1.2, kChartBorder);
    text(panel.parameter, {left, above - px(6)}, Align::Left, kText, Weight::Bold);
    for (const bool signal : {true, false}) {
      for (std::size_t i = 0; i < panel.series.size(); ++i) {
        CurveStyle style = style_of(study, panel.series[i]->method);
        if (style.signal != signal) continue;
        for (std::size_t later = i + 1; later < panel.series.size(); ++later)
          style.covered += covers(*panel.series[later], *panel.series[i]) ? 1 : 0;
        curve(*panel.series[i], style, x, y);
      }
    }
    if (panel.begins_row && has_zero(panel))
      text("0", {left - px(8), bottom + px(5)}, Align::Right, kQuietText);
    float row = above + px(2 + 0.5 * kFailureRow);
    for (const trace::StudySeries* series : panel.series) {
      if (failures(*series, x, left, right, row)) row += px(kFailureRow);
    }
  }

  void marker(const Point2& at, const CurveStyle& style) const {
    draw_marker(Marker::Circle, at, px(3.4 + style.wider()), style.color, drawing());
    if (style.dashed) draw_marker(Marker::Circle, at, px(1.9), kWhite, drawing());
  }

  void curve(const trace::StudySeries& series, const CurveStyle& style, const Axis& x,
             const Axis& y) const {
    const auto place = [&](const trace::StudyPoint& point) {
      return Point2{x.at(point.parameter), y.at(largest_error(point))};
    };
    for (std::size_t i = 1; i < series.points.size(); ++i) {
      const trace::StudyPoint &before = series.points[i - 1], &point = series.points[i];
      if (!before.error || !point.error) continue;
      line(place(before), place(point), style.signal ? 1.5 : 2.2 + style.wider(), style.color,
           style.dash());
    }
    if (style.signal) return;
    for (const trace::StudyPoint& point : series.points) {
      if (point.error) marker(place(point), style);
    }
  }

  /// Crosses, and their count at the end where fewer of them are. False where there are none.
  bool failures(const trace::StudySeries& series, const Axis& x, float left, float right,
                float row) const {
    int on_the_left = 0, crosses = 0;
    for (const trace::StudyPoint& point : series.points) {
      if (point.failed == 0) continue;
      const float at = x.at(point.parameter);
      ++crosses;
      on_the_left += at < 0.5f * (left + right);
      cross({at, row}, 3.6, 1.8, style_of(study, series.method).color);
    }
    if (crosses == 0) return false;
    const bool at_left = 2 * on_the_left < crosses;
    text(spell_failures(series), {at_left ? left + px(6) : right - px(6), row + px(5)},
         at_left ? Align::Left : Align::Right, kQuietText);
    return true;
  }
};

}  // namespace

Drawing plot_curves(const trace::Study& study, int width, int height) {
  const auto points = points_of(study);
  const bool any_failed =
      std::ranges::any_of(points, [](const trace::StudyPoint& p) { return p.failed > 0; });
  // What has one value a point, such as a time or a share, has no largest one.
  const bool has_worst = std::ranges::any_of(points, [](const trace::StudyPoint& p) {
    return p.error && p.error_worst && *p.error_worst > *p.error;
  });
  std::string shown = has_worst ? "Largest " + study.error : study.error;
  shown[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(shown[0])));
  PlotPage page = plot_page(study, shown, width, height);
  PositiveRange errors;
  for (const trace::StudyPoint& point : points) errors.include(largest_error(point));
  if (errors.high == 0) errors = {1e-16, 1};
  const Curves curves{Pen(page.drawing, page.scale, kPlotText), study, errors, any_failed};
  curves.legend(page.legend);
  for (const PlotPanel& panel : panels_on(page, study, kLeft)) curves.panel(panel);
  return page.drawing;
}

}  // namespace contactscope::draw
