#include "draw/charts/plot_curves.h"

#include <algorithm>

#include "draw/charts/method_style.h"
#include "draw/charts/plot_page.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

constexpr double kLeft = 52;
constexpr double kFailureRow = 15;

struct CurveStyle {
  Color color;
  bool dashed = false;
  bool signal = false;
};

/// One colour for all series whose names begin alike.
CurveStyle style_of(const trace::Study& study, const std::string& method) {
  if (method == study.signal) return {kDropped, true, true};
  constexpr Color kColors[] = {rgb(0xD55E00), rgb(0x0072B2), rgb(0x009E73), rgb(0xCC79A7)};
  std::vector<std::string> stems;
  const auto stem_of = [](const std::string& name) { return name.substr(0, name.find(',')); };
  for (const trace::StudySeries& series : study.series) {
    if (series.method == study.signal) continue;
    const std::string stem = stem_of(series.method);
    if (std::ranges::find(stems, stem) == stems.end()) stems.push_back(stem);
  }
  const auto index =
      static_cast<std::size_t>(std::ranges::find(stems, stem_of(method)) - stems.begin());
  return {kColors[index % std::size(kColors)], method.find(',') != std::string::npos, false};
}

class Curves {
 public:
  Curves(const trace::Study& study, Drawing& drawing, float scale)
      : study_(study), pen_(drawing, scale, kPlotText) {}

  void legend(const Point2& start) {
    float at = start.x;
    const float middle = start.y;
    std::vector<std::string> told;
    const auto entry = [&](const std::string& name, auto&& swatch) {
      swatch(at);
      pen_.text(name, {at + px(36), middle + px(5)}, Align::Left, kText);
      at += px(36) + pen_.width_of(name) + px(26);
    };
    for (const trace::StudySeries& series : study_.series) {
      if (std::ranges::find(told, series.method) != told.end()) continue;
      told.push_back(series.method);
      const CurveStyle style = style_of(study_, series.method);
      entry(series.method, [&](float left) {
        pen_.line({left, middle}, {left + px(30), middle}, style.signal ? 1.5 : 2.5, style.color,
                  style.dashed ? 5 : 0);
        if (!style.signal) marker({left + px(15), middle}, style);
      });
    }
    entry("failures, of all cases", [&](float left) {
      pen_.cross({left + px(15), middle}, 4, 1.8, kText);
    });
  }

  void panels(const Rect& space) {
    const std::vector<PlotPanel> all = panels_of(study_);
    const std::vector<Rect> areas = panel_areas(space, all.size(), kLeft, px(1));
    PositiveRange errors;
    for (const trace::StudySeries& series : study_.series) {
      for (const trace::StudyPoint& point : series.points) errors.include(largest_error(point));
    }
    if (errors.high == 0) errors = {1e-16, 1};
    for (std::size_t i = 0; i < all.size(); ++i) {
      panel(all[i], areas[i], errors, areas[i].x == areas[0].x);
    }
  }

 private:
  float px(double at_720) const { return pen_.px(at_720); }

  void marker(const Point2& at, const CurveStyle& style) {
    draw_marker(Marker::Circle, at, px(3.4), style.color, pen_.drawing());
    if (style.dashed) draw_marker(Marker::Circle, at, px(1.9), kWhite, pen_.drawing());
  }

  void panel(const PlotPanel& panel, const Rect& area, const PositiveRange& errors, bool labelled) {
    std::vector<const trace::StudySeries*> failing;
    PositiveRange parameters;
    for (const trace::StudySeries* series : panel.series) {
      for (const trace::StudyPoint& point : series->points) parameters.include(point.parameter);
      if (std::ranges::any_of(series->points, [](const auto& p) { return p.failed > 0; })) {
        failing.push_back(series);
      }
    }
    const auto left = static_cast<float>(area.x);
    const auto right = static_cast<float>(area.x + area.width);
    const auto bottom = static_cast<float>(area.y + area.height);
    // Room for the rows of all panels alike, so that one height means one error everywhere.
    const float top = static_cast<float>(area.y) + px(4 * kFailureRow + 4);
    const Axis x = Axis::logarithmic(parameters.low, parameters.high, left, right, px(8), px(8));
    const Axis y = Axis::logarithmic(errors.low, errors.high, bottom, top, px(6), px(6));
    draw_decades_along(x, area, true, pen_);
    draw_decades_up(y, area, true, labelled, pen_);
    pen_.frame(area, 1.2, kChartBorder);
    pen_.text(panel.parameter, {left, static_cast<float>(area.y) - px(6)}, Align::Left, kText,
              Weight::Bold);
    for (const bool signal : {true, false}) {
      for (const trace::StudySeries* series : panel.series) {
        const CurveStyle style = style_of(study_, series->method);
        if (style.signal == signal) curve(*series, style, x, y);
      }
    }
    float row = static_cast<float>(area.y) + px(2 + 0.5 * kFailureRow);
    for (const trace::StudySeries* series : failing) {
      failures(*series, style_of(study_, series->method), x, left, right, row);
      row += px(kFailureRow);
    }
  }

  void curve(const trace::StudySeries& series, const CurveStyle& style, const Axis& x,
             const Axis& y) {
    const trace::StudyPoint* before = nullptr;
    for (const trace::StudyPoint& point : series.points) {
      if (before != nullptr && before->error && point.error) {
        pen_.line({x.at(before->parameter), y.at(largest_error(*before))},
                  {x.at(point.parameter), y.at(largest_error(point))}, style.signal ? 1.5 : 2.2,
                  style.color, style.dashed ? 5 : 0);
      }
      before = &point;
    }
    if (style.signal) return;
    for (const trace::StudyPoint& point : series.points) {
      if (point.error) marker({x.at(point.parameter), y.at(largest_error(point))}, style);
    }
  }

  void failures(const trace::StudySeries& series, const CurveStyle& style, const Axis& x,
                float left, float right, float row) {
    int failed = 0, of = 0, on_the_left = 0, crosses = 0;
    for (const trace::StudyPoint& point : series.points) {
      failed += point.failed;
      of += point.of;
      if (point.failed == 0) continue;
      ++crosses;
      on_the_left += x.at(point.parameter) < 0.5f * (left + right) ? 1 : 0;
      pen_.cross({x.at(point.parameter), row}, 3.6, 1.8, style.color);
    }
    const std::string count = std::to_string(failed) + " of " + std::to_string(of);
    const bool at_left = 2 * on_the_left < crosses;
    pen_.text(count, {at_left ? left + px(6) : right - px(6), row + px(5)},
              at_left ? Align::Left : Align::Right, kQuietText);
  }

  const trace::Study& study_;
  Pen pen_;
};

}  // namespace

Drawing plot_curves(const trace::Study& study, int width, int height) {
  PlotPage page = plot_page(study, "Largest " + study.error, width, height);
  Curves curves(study, page.drawing, page.scale);
  curves.legend(page.legend);
  curves.panels(page.panels);
  return page.drawing;
}

}  // namespace contactscope::draw
