#pragma once

#include "draw/scene/drawing.h"
#include "trace/study.h"

namespace contactscope::draw {

/// A line of a chart over time, for draw_over_time(). One value per time.
trace::StudySeries line_over_time(const std::string& name, const std::vector<double>& time,
                                  const std::vector<double>& values);

/// A page of several runs: a result, charts over time side by side if any, and below them room for
/// pictures.
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
                         const std::vector<trace::Study>& charts,
                         const std::vector<RolloutCell>& cells, int width, int height);

/// Height of a page of the usual width with this number of cells.
int rollout_page_height(std::size_t cells);

}  // namespace contactscope::draw
