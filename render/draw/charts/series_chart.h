#pragma once

#include <string>
#include <vector>

#include "draw/scene/camera.h"
#include "draw/scene/drawing.h"

namespace contactscope::draw {

/// How one of a few curves of a chart looks.
struct SeriesStyle {
  Color color;
  float dash = 0;  // pixels at 720 lines; solid when 0
};
SeriesStyle series_style(std::size_t index);

/// Something changed between a frame and the one before it.
struct SeriesChange {
  std::size_t frame = 0;
  std::string before, after;  // what it was and what it is
};

/// A small chart of values over frames: what it shows and its newest value above it; to its left
/// ticks at zero and at a round value on each side of zero that it reaches.
struct SeriesChart {
  std::string name;
  std::string unit;  // "m", with a prefix that suits; empty: a plain number
  std::vector<std::vector<double>> curves{};  // a value a frame of the whole sequence, NaN: none
  bool steps = false;                         // whole numbers: drawn as stairs
  bool baseline = false;                      // values go below zero: the zero line is drawn strong
  std::vector<SeriesChange> changes{};
  bool total = false;     // one curve of what other charts have several of: in the colour of text
  std::string subject{};  // whose the newest value is; of one curve
};

/// Pixels at 720 lines.
inline constexpr double kChartText = 15;
inline constexpr double kChartGutter = 46;

/// Draws frames 0 to `moment` on an axis that holds all frames. `rect` is all that the chart may
/// use, its gutter and heading included; `pixel` is one pixel at 720 lines.
void draw_series_chart(const SeriesChart& chart, std::size_t moment, const Rect& rect, float pixel,
                       Drawing& drawing);

/// Text of a chart; `at` on the baseline.
void chart_text(const std::string& text, const Point2& at, Align align, const Color& color,
                float pixel, Drawing& drawing, Weight weight = Weight::Regular);

}  // namespace contactscope::draw
