#pragma once

#include <limits>
#include <string>
#include <vector>

#include "draw/charts/axis.h"
#include "draw/scene/camera.h"
#include "draw/scene/drawing.h"
#include "draw/scene/pen.h"
#include "trace/study.h"

namespace contactscope::draw {

/// Labels as many decades of a logarithmic axis as fit under the lower edge of the area, and draws
/// their grid lines if asked to.
void draw_decades_along(const Axis& axis, const Rect& area, bool grid, const Pen& pen);
/// The same along its left edge; without labels the grid alone.
void draw_decades_up(const Axis& axis, const Rect& area, bool grid, bool labels, const Pen& pen);

/// Values > 0 that an axis is to hold.
struct PositiveRange {
  double low = std::numeric_limits<double>::infinity();
  double high = 0;

  void include(double value);
  /// Some range also where nothing was included.
  PositiveRange or_else(double value) const {
    return high > 0 ? *this : PositiveRange{value, value};
  }
};

/// The larger error of a point.
double largest_error(const trace::StudyPoint& point);

/// The panels of a study, in the order of the series, which stay together.
struct PlotPanel {
  std::string name;
  std::string parameter;
  std::vector<const trace::StudySeries*> series;
};
std::vector<PlotPanel> panels_of(const trace::Study& study);

/// Places for so many panels in two rows, with room for labels to the left of each row and under
/// each panel, and for a heading over it; `left` in pixels at 720 lines.
std::vector<Rect> panel_areas(const Rect& space, std::size_t count, double left, float scale);

/// "CPU · compiler · build · date", and if asked for the scalar.
std::string spell_context(const trace::StudyContext& context, bool with_scalar);

/// Size of text in plots of a study, pixels at 720 lines.
inline constexpr double kPlotText = 14;

/// A picture of small multiples: its frame is drawn, and says where the rest belongs.
struct PlotPage {
  Drawing drawing;
  float scale;    // pixels for one at 720 lines
  Point2 legend;  // its left end, half-way up
  Rect panels;
};
/// With the captions of a study, and under its title a line that says what is shown.
PlotPage plot_page(const trace::Study& study, const std::string& shown, int width, int height);

}  // namespace contactscope::draw
