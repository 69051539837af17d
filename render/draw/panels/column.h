#pragma once

#include <vector>

namespace contactscope::draw {

/// How high one panel of a column must, can and would be, in pixels.
struct PanelNeed {
  float least = 0;   // below this it says nothing
  float good = 0;    // at which nothing that it shows is left out; not below `least`
  float wanted = 0;  // where it has no use for more; 0: it takes its share of what is left
  float share = 0;   // of what panels without a wanted height divide
};

/// Divides a column among its panels: a height for each, in their order, 0 for those that have no
/// room. Each gets its least height; from what is left first the good ones are reached and then the
/// wanted ones, in order; the others divide the rest by their shares, none less than it has. Where
/// even the least heights do not fit, the last panels are left out, and `note` pixels are kept below
/// the others for a line that says so. The first panel is always there, cut to the column. `gap`:
/// between two panels.
std::vector<float> divide_column(const std::vector<PanelNeed>& needs, float height, float gap,
                                 float note);

}  // namespace contactscope::draw
