#pragma once

#include <array>
#include <string>
#include <vector>

#include "draw/charts/plot.h"

namespace contactscope::draw {

/// Where the points of one method fall, pixels.
struct Course {
  std::string method;
  MethodStyle style;
  bool strong = false;                       // on the front
  std::vector<Point2> points;                // those with an error, in the order of the parameter
  std::vector<std::array<float, 2>> spread;  // x of the least and greatest time of each
  std::vector<float> failures;               // x of the points with failures
  std::string failure_text;                  // "mjx: 3 of 120"
  Point2 failure_text_at;                    // left end of the baseline
  float failure_row = 0;                     // y of the crosses
};

/// A panel of a plot, as pixels. From top to bottom: rows of failures where there are any, the
/// logarithmic area, and the row of errors that are zero or within the study's resolution.
struct PlotGeometry {
  Rect area;               // all three
  float failures_end = 0;  // y where the rows of failures end; the area's top when there are none
  float zeros_begin = 0;   // y where the row of zeros begins; the area's bottom when there are none
  std::string zeros_label;  // "0", or "≤ 10⁻⁶" where some are not exactly zero
  Axis x, y;
  std::vector<Course> courses;  // one a series, in order
};

/// Maps a study's points into `area`, with room to the right of the slowest for the widest label.
/// Axes span the points of `whole`, which is the study or what it is a panel of.
PlotGeometry plot_geometry(const trace::Study& study, ErrorKind kind, const Rect& area, float scale,
                           const trace::Study& whole);

/// One diagram of plot(), in `rect`: heading, axes and all that lies between them. Where series have
/// a panel, those of `panel` are drawn alone, under its name.
void draw_plot_panel(const trace::Study& study, ErrorKind kind, const Rect& rect, PlotPage& page,
                     const std::string& panel);

}  // namespace contactscope::draw
