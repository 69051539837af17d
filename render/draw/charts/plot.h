#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/at.h"
#include "draw/charts/axis.h"
#include "draw/scene/pen.h"
#include "trace/study.h"

namespace contactscope::draw {

/// A study in its form; those of curves, maps and answers are below.
///
/// Work precision: error against run time, both axes logarithmic, a line a method, a panel for the
/// mean error and one for the worst where the study has it, one above the other on a page that is
/// higher than wide. Where the series belong to panels, these are drawn instead, of the mean error,
/// over the same ranges.
///
/// Lines run through the parameters in order and are labelled at their ends. Methods that no other
/// beats in both time and error are strong, with the least and greatest time of a call as a thin
/// band; the others are muted, and bands of many would hide each other. Errors of zero, and those
/// within the study's resolution, stand in a row under the axis; failures are crosses in rows above
/// it, with their count.
Drawing plot(const trace::Study& study, int width, int height);

/// Small multiples of a study of form Curves: in each panel the largest error of every series
/// against the parameter, both logarithmic; a parameter that counts one by one, as frames do, is not, and
/// shares and multiples are not, whose axis begins at zero unless all are far from it. The error axis is the same in all panels. Series of the
/// same name look the same everywhere: solid and filled, or dashed and hollow where the name goes on
/// after a comma ("float, unrounded" beside "float"). They are named at their ends in up to three panels,
/// once where all have the same, and in a legend in more. The series that study.signal names is a grey
/// line: errors above it drown what is measured. Failures are crosses in rows at the top, with how
/// many of how many cases, and zeros stand in a row below a logarithmic axis; a line parts both from the rest.
Drawing plot_curves(const trace::Study& study, int width, int height);

/// Panels of a study of form Map: a cell for every parameter (to the right, logarithmic) and row (up,
/// logarithmic, or a line each for rows that are names), in the colour of the decade of its largest
/// error, with a cross where cases failed. Darker is worse; a cell of failures alone is white. Cells that are
/// marked with the same words have one line about them.
Drawing plot_map(const trace::Study& study, int width, int height);

/// Panels of a study of form Answers, side by side: a cell for every parameter (to the right) and row
/// (up), whole numbers from one to the next, in the colour of what was answered there, and a black
/// square in it where that is wrong. Over each panel stands how many are.
Drawing plot_answers(const trace::Study& study, int width, int height);

/// Labels as many decades of a logarithmic axis as fit under the lower edge of the area, or round numbers
/// of another one, and draws their grid lines if asked to. Where `values` are named, they have the ticks instead.
void draw_decades_along(const Axis& axis, const Rect& area, bool grid, const Pen& pen,
                        const std::vector<double>& values = {});
/// The same along its left edge; without labels the grid alone.
void draw_decades_up(const Axis& axis, const Rect& area, bool grid, bool labels, const Pen& pen);

/// Values > 0 that an axis is to hold.
struct PositiveRange {
  double low = std::numeric_limits<double>::infinity();
  double high = 0;

  void include(double value);
  /// So many pixels before and after them, as Axis::logarithmic has it. An axis about 1 where nothing
  /// was included.
  Axis axis(float from, float to, float before, float after) const;
};

/// Those of all series.
inline auto points_of(const trace::Study& study) {
  return joined(study.series, &trace::StudySeries::points);
}

/// The larger error of a point.
double largest_error(const trace::StudyPoint& point);

/// "3 of 120": how many of the cases of a series failed.
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

/// How a method looks in every plot of a study: no two of up to 63 look the same, and each
/// of colour, marker and dash alone already sets neighbours apart.
struct MethodStyle {
  Color color;  // Okabe-Ito
  Color text;   // the same hue, dark enough for letters on white
  Marker marker = Marker::Circle;
  float dash = 0, gap = 0;  // pixels at 720 lines; solid when gap is 0
};

MethodStyle method_style(std::size_t index);

/// Paints a marker about `center`; `radius` in pixels is that of the circle. All shapes weigh about
/// the same.
void draw_marker(Marker marker, const Point2& center, float radius, const Color& color,
                 Drawing& drawing);

/// Which error of a study's points.
enum class ErrorKind { Mean, Worst };
const std::optional<double>& error_of(const trace::StudyPoint& point, ErrorKind kind);

/// For each series whether at least half of its points are beaten by no other point at the same
/// parameter: none is as fast and as close, and better in one of them. Where the study has panels,
/// whose parameter is how hard a method tries at the same cases, by no other point at all, unless it says that these are others. By
/// median time. A point without an error is beaten.
std::vector<bool> on_front(const trace::Study& study, ErrorKind kind);

/// A picture of a study: its frame is drawn, and says where the rest belongs.
struct PlotPage {
  Drawing drawing;
  float scale;    // pixels for one at 720 lines; more where few diagrams leave room for it
  Point2 legend;  // its left end, half-way up
  Rect panels;
};
/// With the captions of a study, and under its title a line that says what is shown. Below that is
/// room for a legend where there is one.
PlotPage plot_page(const trace::Study& study, const std::string& shown, bool has_legend, int width,
                   int height);

/// A panel of a study, and its place on a page of small multiples.
struct PlotPanel {
  std::string name;
  std::string parameter;
  std::vector<const trace::StudySeries*> series;
  Rect area{};
  bool begins_row = false;  // the labels left of it are those of the whole row
};
/// The panels of a study, in the order of the series, which stay together.
std::vector<PlotPanel> panels_of(const trace::Study& study);
/// The same placed in up to two rows of a page, with room for labels to the left of each row and
/// under each panel, and for a heading over it; `left` in pixels at 720 lines.
std::vector<PlotPanel> panels_on(const PlotPage& page, const trace::Study& study, double left);

/// Where the points of one method fall, pixels.
struct Course {
  std::string method;
  MethodStyle style;
  bool strong = false;                       // on the front
  bool quiet = false;                        // there to hold the others against
  std::vector<Point2> points;                // those with an error, in the order of the parameter
  std::vector<double> parameters;            // of these
  std::vector<std::string> marks;            // of these; empty: it is not marked
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
