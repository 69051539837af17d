#pragma once

#include <string>
#include <vector>

#include "draw/scene/pen.h"

namespace contactscope::draw {

/// How one of a few curves of a chart looks.
struct SeriesStyle {
  Color color;
  float dash = 0;  // pixels at 720 lines; solid when 0
};
SeriesStyle series_style(std::size_t index);

/// A small chart of values over frames: what it shows and its newest value above it; to its left
/// ticks at zero and at a round value on each side of zero that it reaches.
struct SeriesChart {
  /// Something is another in a frame than in the one before it.
  struct Change {
    std::size_t frame = 0;
    std::string before, after;  // what it was and what it is
  };

  std::string name;
  std::string unit;  // "m", with a prefix that suits; empty: a plain number
  std::vector<std::vector<double>> curves{};  // a value a frame of the whole sequence, NaN: none
  bool steps = false;                         // whole numbers: drawn as stairs
  bool baseline = false;                      // values go below zero: the zero line is drawn strong
  std::vector<Change> changes{};
  bool total = false;  // one curve of what other charts have several of: in the colour of text
  std::vector<std::string> subjects{};  // of one curve: whose its value is, a name a frame

  /// Bounds of all values and zero, of a sequence in which nothing happens zero and one. fit() sets
  /// them, once the curves are there.
  double low = 0, high = 1;
  void fit();
};

/// Sizes in pixels at 720 lines: of text, and of the room for ticks left of a chart.
inline constexpr double kChartText = 15;
inline constexpr double kChartGutter = 46;

/// What `rect` leaves for curves beside the ticks and under `heading` pixels at 720 lines.
Rect chart_area(const Rect& rect, double heading, const Pen& pen);

/// Draws frames 0 to `moment` on an axis that holds all frames. `rect` is all that the chart may
/// use, its gutter and heading included.
void draw_series_chart(const SeriesChart& chart, std::size_t moment, const Rect& rect,
                       const Pen& pen);

/// How the curve of this number looks, `length` pixels at 720 lines.
void draw_series_swatch(std::size_t index, const Point2& left, double length, const Pen& pen);

/// A line at a frame of so many, from a little above a chart to a little below it.
void draw_moment(const Rect& chart, std::size_t frames, std::size_t moment, const Pen& pen);

/// Under charts of the whole sequence: "0", "time", and how long it is in seconds.
void draw_time_axis(double duration, double left, double width, double baseline, const Pen& pen);

}  // namespace contactscope::draw
