#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/charts/plot.h"
#include "draw/scene/pen.h"

namespace contactscope::draw {

/// One method's line in a chart of several.
struct TimeLine {
  std::string name;
  std::size_t style = 0;                // index for method_style()
  std::vector<double> time;             // seconds, ascending
  std::vector<double> values;           // one per time; finite
  bool breaks_off = false;              // stops early: a cross marks its last value
  bool quiet = false;                   // grey, behind the others
  std::optional<std::size_t> marked{};  // index of a value with a ring, labelled `name` `mark`
  std::string mark{};
};

/// Several lines over a common time, each named at its end. Both axes are linear.
struct TimeChart {
  std::string name;
  std::string unit;  // "m", "J"; the axis has a suitable prefix
  std::vector<TimeLine> lines{};
};

/// Draws a chart into `rect`, with its name above, ticks to the left and below, and names of lines
/// to the right. A line that ends early is named there, and a marked one at its mark. A line that
/// reaches more than five times as far as the others leaves the axis, and its name contains its
/// largest value.
void draw_time_chart(const TimeChart& chart, const Rect& rect, const Pen& pen);

/// A page of several runs: a result, charts side by side if any, and below them room for pictures.
struct RolloutPage {
  Drawing drawing;
  std::vector<Rect> cells;  // whole pixels
};

/// A cell below the charts: its name in the colour of its line, and a `note`. On the page, `result`
/// is the heading, and `title` names the scene.
struct RolloutCell {
  std::string name, note;
  std::size_t style = 0;
  bool quiet = false;  // like its line
};
RolloutPage rollout_page(const std::string& result, const std::string& title,
                         const std::string& source, const std::string& moment,
                         const std::vector<TimeChart>& charts,
                         const std::vector<RolloutCell>& cells, int width, int height);

/// Height of a page of the usual width with this number of cells.
int rollout_page_height(std::size_t cells);

}  // namespace contactscope::draw
