#include "draw/charts/plot_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "draw/charts/plot_page.h"
#include "draw/scene/hatch.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

constexpr double kLeftNumbers = 56;
constexpr double kLeftNames = 132;

// From white over Okabe-Ito's sky blue and blue to near black: lightness alone tells the order.
constexpr std::array<Color, 8> kDecades = {rgb(0xEAF5FC), rgb(0xC4E3F6), rgb(0x8FCBEE),
                                           rgb(0x56B4E9), rgb(0x1F88C4), rgb(0x005F96),
                                           rgb(0x003F66), rgb(0x001F33)};
constexpr Color kFailure = rgb(0xD55E00);

/// Errors up to 1 are the first, up to 10 the second, and so on; the last takes all above.
std::size_t decade_of(double error) {
  if (!(error > 1)) return 0;
  const double above = std::ceil(std::log10(error));
  return static_cast<std::size_t>(std::clamp(above, 0.0, double(kDecades.size() - 1)));
}

class Map {
 public:
  Map(const trace::Study& study, Drawing& drawing, float scale)
      : study_(study), pen_(drawing, scale, kPlotText) {
    for (const trace::StudySeries& series : study.series) {
      numbered_ = numbered_ && series.row.has_value();
    }
  }

  void legend(const Point2& begin) {
    float at = begin.x;
    const float middle = begin.y;
    std::size_t most = 0;
    for (const trace::StudySeries& series : study_.series) {
      for (const trace::StudyPoint& point : series.points) {
        if (point.error) most = std::max(most, decade_of(largest_error(point)));
      }
    }
    for (std::size_t i = 0; i <= most; ++i) {
      const Rect box{at, middle - px(8), px(26), px(16)};
      pen_.fill(box, kDecades[i]);
      pen_.frame(box, 1.2, kChartBorder);
      const bool open = i + 1 == kDecades.size();
      const double bound = std::pow(10.0, static_cast<double>(open ? i - 1 : i));
      const std::string name = (open ? "> " : "≤ ") + spell_tick_error(bound, "");
      pen_.text(name, {at + px(32), middle + px(5)}, Align::Left, kText);
      at += px(32) + pen_.width_of(name) + px(18);
    }
    pen_.cross({at + px(10), middle}, 5, 1.8, kFailure);
    at += px(22);
    pen_.text("cases failed", {at, middle + px(5)}, Align::Left, kText);
    at += pen_.width_of("cases failed") + px(18);
    const Rect box{at, middle - px(8), px(26), px(16)};
    hatched(box);
    pen_.frame(box, 1.2, kChartBorder);
    pen_.text("all of them", {at + px(32), middle + px(5)}, Align::Left, kText);
  }

  void panels(const Rect& space) {
    const std::vector<PlotPanel> all = panels_of(study_);
    const std::vector<Rect> areas =
        panel_areas(space, all.size(), numbered_ ? kLeftNumbers : kLeftNames, px(1));
    for (std::size_t i = 0; i < all.size(); ++i) {
      panel(all[i], areas[i], areas[i].x == areas[0].x);
    }
  }

 private:
  float px(double at_720) const { return pen_.px(at_720); }

  /// Half a cell beyond the first and the last value.
  static Axis axis_of(const std::vector<double>& values, double from, double to) {
    const double cell = std::abs(to - from) / static_cast<double>(values.size());
    const auto half = static_cast<float>(0.5 * cell);
    return Axis::logarithmic(values.front(), values.back(), static_cast<float>(from),
                             static_cast<float>(to), half, half);
  }

  void panel(const PlotPanel& panel, const Rect& area, bool labelled) {
    std::vector<double> parameters;
    for (const trace::StudyPoint& point : panel.series.front()->points) {
      parameters.push_back(point.parameter);
    }
    if (parameters.empty()) return;
    const double bottom = area.y + area.height;
    const Axis x = axis_of(parameters, area.x, area.x + area.width);
    const double cell_width = area.width / static_cast<double>(parameters.size());
    const double cell_height = area.height / static_cast<double>(panel.series.size());
    for (std::size_t row = 0; row < panel.series.size(); ++row) {
      // Numbers grow upwards, names are read downwards.
      const double from_top =
          static_cast<double>(numbered_ ? panel.series.size() - 1 - row : row) * cell_height;
      for (const trace::StudyPoint& point : panel.series[row]->points) {
        const double left = x.at(point.parameter) - 0.5 * cell_width;
        cell(point, {left, area.y + from_top, cell_width, cell_height});
      }
      if (numbered_ || !labelled) continue;
      pen_.text(panel.series[row]->method,
                {static_cast<float>(area.x) - px(8),
                 static_cast<float>(area.y + from_top + 0.5 * cell_height) + px(5)},
                Align::Right, kText);
    }
    if (numbered_) {
      std::vector<double> rows;
      for (const trace::StudySeries* series : panel.series) rows.push_back(*series->row);
      draw_decades_up(axis_of(rows, bottom, area.y), area, false, labelled, pen_);
    }
    draw_decades_along(x, area, false, pen_);
    pen_.frame(area, 1.2, kChartBorder);
    const float above = static_cast<float>(area.y) - px(6);
    pen_.text(panel.name, {static_cast<float>(area.x), above}, Align::Left, kText, Weight::Bold);
    const std::string axes =
        "across: " + panel.parameter + (numbered_ ? ", up: " + study_.row : "");
    if (pen_.width_of(axes) + pen_.width_of(panel.name, Weight::Bold) + px(12) < area.width) {
      pen_.text(axes, {static_cast<float>(area.x + area.width), above}, Align::Right, kQuietText);
    }
  }

  /// A cell without a value is hatched: white alone would look like the smallest error.
  void hatched(const Rect& rect) {
    const double right = rect.x + rect.width, bottom = rect.y + rect.height;
    hatch({{rect.x, rect.y}, {right, rect.y}, {right, bottom}, {rect.x, bottom}}, {}, px(6), px(1),
          with_alpha(kDropped, 0.4f), pen_.drawing());
  }

  void cell(const trace::StudyPoint& point, const Rect& rect) {
    if (point.error) pen_.fill(rect, kDecades[decade_of(largest_error(point))]);
    if (point.failed == 0) return;
    if (!point.error) hatched(rect);
    const double room = 0.32 * std::min(rect.width, rect.height) / px(1);
    const Point2 middle{static_cast<float>(rect.x + 0.5 * rect.width),
                        static_cast<float>(rect.y + 0.5 * rect.height)};
    pen_.cross(middle, std::clamp(room, 2.0, 5.0), 1.8, kFailure);
  }

  const trace::Study& study_;
  Pen pen_;
  bool numbered_ = true;
};

}  // namespace

Drawing plot_map(const trace::Study& study, int width, int height) {
  PlotPage page = plot_page(study, "Colour: " + study.error, width, height);
  Map map(study, page.drawing, page.scale);
  map.legend(page.legend);
  map.panels(page.panels);
  return page.drawing;
}

}  // namespace contactscope::draw
