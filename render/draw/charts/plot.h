#pragma once

#include "draw/charts/axis.h"
#include "draw/scene/pen.h"
#include "trace/study.h"

namespace contactscope::draw {

/// Plots a study in its form. All but work precision have functions below.
///
/// Work precision: error against run time, both axes logarithmic, one line per method. One panel
/// for the mean error and one for the worst if the study has it, stacked on a portrait page. If
/// series belong to panels, these are drawn instead, for the mean error, over the same ranges.
///
/// Lines run through the parameters in order and are labelled at their ends. Methods that no other
/// beats in both time and error are strong, with the range of a call's times as a thin band; the
/// others are muted, without bands, which would hide each other. Errors of zero, or within the
/// study's resolution, are in a row under the axis. Failures are crosses in rows above it, with
/// their count.
Drawing plot(const trace::Study& study, int width, int height);

/// Small multiples of a study of form Curves: in each panel the largest error of every series
/// against the parameter, both logarithmic. Linear are parameters that count one by one, such as
/// frames, and axes of shares and multiples, which begin at zero unless all values are far from it.
/// All panels share the error axis. Series of the same name look the same everywhere: solid and
/// filled, or dashed and hollow if the name continues after a comma ("float, unrounded"). Names are
/// at the ends in up to three panels, once if all have the same lines, otherwise in a legend.
/// study.signal is a grey line: larger errors hide what is measured. Failures are crosses in rows
/// at the top, with counts; zeros are in a row below a logarithmic axis; lines separate both.
Drawing plot_curves(const trace::Study& study, int width, int height);

/// Lines over time into a part of a picture: a study with one panel, at least one line and an error
/// at every point, whose parameter is the time in seconds. Both axes are linear; that of the errors
/// has zero unless all are far from it, and a suitable prefix for the unit. A line that reaches more
/// than five times as far as usual leaves it, and its name says how far. A point with failures is
/// the early end of its line: a cross.
void draw_over_time(trace::Study study, const Rect& rect, const Pen& pen);

/// Panels of a study of form Map: a cell for every parameter (to the right, logarithmic) and row
/// (up, logarithmic, or one line each for named rows), in the colour of the decade of its largest
/// error, with a cross if cases failed. Darker is worse; a cell without successful cases is
/// hatched. Cells with the same mark have a common outline.
Drawing plot_map(const trace::Study& study, int width, int height);

/// Panels of a study of form Answers, side by side: a cell for every parameter (to the right) and
/// row (up), both consecutive integers, in the colour of the answer, with a black square if it is
/// wrong. Above each panel is the number of wrong answers.
Drawing plot_answers(const trace::Study& study, int width, int height);

/// Panels of a study of form Bars, side by side: a bar per series, linear from zero, with its mark at
/// the end; without an error a cross. study.signal is a goal: a dashed line across the bars.
Drawing plot_bars(const trace::Study& study, int width, int height);

/// Labels the lower edge of the area: decades of a logarithmic axis, as many as fit, or round
/// numbers. Draws grid lines if `grid`. If `values` is not empty, it gives the ticks instead.
void draw_decades_along(const Axis& axis, const Rect& area, bool grid, const Pen& pen,
                        const std::vector<double>& values = {});
/// The same along the left edge; without labels only the grid.
void draw_decades_up(const Axis& axis, const Rect& area, bool grid, bool labels, const Pen& pen);

/// The same for about six round numbers on a linear axis, times `factor` and with `unit`. Zero is
/// strong if values may be negative.
void draw_linear_up(const Axis& axis, const Rect& area, double factor, const std::string& unit,
                    bool labels, const Pen& pen);

/// Range of the positive values on an axis.
struct PositiveRange {
  double low = std::numeric_limits<double>::infinity();
  double high = 0;

  void include(double value);
  /// With these margins in pixels, as in Axis::logarithmic; about 1 if nothing was included.
  Axis axis(float from, float to, float before, float after) const;
};

/// Points of all series.
inline auto points_of(const trace::Study& study) {
  return joined(study.series, &trace::StudySeries::points);
}

double largest_error(const trace::StudyPoint& point);

/// "3 of 120": number of failed cases of a series.
std::string spell_failures(const trace::StudySeries& series);

/// Size of text in plots of a study, pixels at 720 lines.
inline constexpr double kPlotText = 14;

enum class Marker {
  Circle,
  Square,
  Diamond,
  TriangleUp,
  Plus,
  TriangleDown,
  Ring,
  HollowSquare,
  HollowDiamond,
};

/// Style of a method in every plot of a study. Up to 63 methods have different styles, and colour,
/// marker or dash alone distinguishes neighbours.
struct MethodStyle {
  Color color;  // Okabe-Ito
  Color text;   // the same hue, dark enough for text on white
  Marker marker = Marker::Circle;
  float dash = 0, gap = 0;  // pixels at 720 lines; solid when gap is 0
};

MethodStyle method_style(std::size_t index);

/// Draws a marker; `radius` in pixels is that of the circle. All shapes have similar visual weight.
void draw_marker(Marker marker, const Point2& center, float radius, const Color& color,
                 Drawing& drawing);

enum class ErrorKind { Mean, Worst };
const std::optional<double>& error_of(const trace::StudyPoint& point, ErrorKind kind);

/// For each series, whether at least half of its points are not dominated by another point with the
/// same parameter: none is at least as fast and as accurate, and better in one. If the study has
/// panels, whose parameter is the effort for the same cases, by no other point at all, unless
/// study.other_cases. Uses the median time. Points without an error are dominated.
std::vector<bool> on_front(const trace::Study& study, ErrorKind kind);

/// The page of a study with its captions, and rectangles for the rest.
struct PlotPage {
  Drawing drawing;
  float scale;    // canvas pixels for one pixel at 720 lines; larger if few diagrams leave room
  Point2 legend;  // its left end, at half height
  Rect panels;
};
/// Draws a study's captions, and below the title a line about the contents; reserves a legend's
/// room.
PlotPage plot_page(const trace::Study& study, const std::string& shown, bool has_legend, int width,
                   int height);

struct PlotPanel {
  std::string name;
  std::string parameter;
  std::vector<const trace::StudySeries*> series;
  Rect area{};
  bool begins_row = false;  // has the labels of its row on the left
};
/// The panels of a study, in the order of the series. Series of a panel stay together.
std::vector<PlotPanel> panels_of(const trace::Study& study);
/// The same with rectangles in up to two rows of a page, with room for labels to the left of each
/// row and below each panel, and for a heading above; `left` in pixels at 720 lines.
std::vector<PlotPanel> panels_on(const PlotPage& page, const trace::Study& study, double left);

/// Points of one method in pixels.
struct Course {
  std::string method;
  MethodStyle style;
  bool strong = false;                       // on the front
  bool quiet = false;                        // a reference to compare with
  std::vector<Point2> points;                // points with an error, in order of the parameter
  std::vector<double> parameters;            // of these points
  std::vector<std::string> marks;            // of these points; empty: not marked
  std::vector<std::array<float, 2>> spread;  // x of each point's least and greatest time
  std::vector<float> failures;               // x of points with failures
  std::string failure_text;                  // "mjx: 3 of 120"
  Point2 failure_text_at;                    // left end of the baseline
  float failure_row = 0;                     // y of the crosses
};

/// A panel of a plot in pixels. From top to bottom: rows of failures, the logarithmic area, and the
/// row of errors that are zero or within the study's resolution.
struct PlotGeometry {
  Rect area;               // all three parts
  float failures_end = 0;  // y of the end of the rows of failures; the area's top if there are none
  float zeros_begin = 0;   // y of the start of the row of zeros; the area's bottom if none
  std::string zeros_label;  // "0", or "≤ 10⁻⁶" if some are not exactly zero
  Axis x, y;
  std::vector<Course> courses;  // one per series, in order
};

/// Maps a study's points into `area`, with room to the right of the slowest for the widest label.
/// Axes span the points of `whole`, which contains `study`.
PlotGeometry plot_geometry(const trace::Study& study, ErrorKind kind, const Rect& area, float scale,
                           const trace::Study& whole);

/// Draws one diagram of plot() in `rect`, with heading and axes. If series have panels, only the
/// series of `panel` are drawn, under its name.
void draw_plot_panel(const trace::Study& study, ErrorKind kind, const Rect& rect, PlotPage& page,
                     const std::string& panel);

}  // namespace contactscope::draw
