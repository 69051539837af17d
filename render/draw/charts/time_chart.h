#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/charts/plot.h"
#include "draw/scene/pen.h"

namespace contactscope::draw {

/// One method's course in a chart of several.
struct TimeLine {
  std::string name;
  std::size_t style = 0;                // of method_style()
  std::vector<double> time;             // seconds, rising
  std::vector<double> values;           // as many; finite
  bool breaks_off = false;              // its last value is not the end: a cross stands there
  bool quiet = false;                   // grey, behind the others
  std::optional<std::size_t> marked{};  // this value has a ring, with its name and these words
  std::string mark{};
};

/// Several lines over the same time, each with its name at its end. Both axes are linear.
struct TimeChart {
  std::string name;
  std::string unit;  // "m", "J"; the axis has a prefix that suits
  std::vector<TimeLine> lines{};
};

/// Draws a chart into `rect`, with its name above it, ticks to the left and under it and names of lines to the right;
/// one that ends early is named where it does, one that is marked at its mark, and several that end at one place are
/// named together, unless they are quiet: those are told by their order.
/// Where one line goes more than five times as far as the others do, the axis leaves it out, and its name says
/// how far it went.
void draw_time_chart(const TimeChart& chart, const Rect& rect, const Pen& pen);

/// A page of several rollouts: what it found, charts side by side, and under them room for a picture of each.
struct RolloutPage {
  Drawing drawing;
  std::vector<Rect> cells;  // whole pixels
};

/// `result` is the heading, `title` says of what scene. As many cells as there are names; below each stands the
/// name in its line's colour, with its `note`.
struct RolloutCell {
  std::string name, note;
  std::size_t style = 0;
  bool quiet = false;  // as its line
};
RolloutPage rollout_page(const std::string& result, const std::string& title,
                         const std::string& source, const std::string& moment,
                         const std::vector<TimeChart>& charts,
                         const std::vector<RolloutCell>& cells, int width, int height);

/// How high a page of the usual width is for so many cells.
int rollout_page_height(std::size_t cells);

}  // namespace contactscope::draw
