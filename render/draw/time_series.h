#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/id_strip.h"
#include "trace/trace.h"

namespace contactscope::draw {

/// What one group of bodies did over a sequence; an entry a frame.
struct TimeSeries {
  std::string name;                 // label of its pairs; empty where no pair has one
  std::vector<double> penetration;  // metres, of the deepest point, 0 without an overlap
  std::vector<double> points;
  // Empty where no frame has a solver.
  std::vector<double> energy;             // joules, kinetic, of the bodies in these pairs
  std::vector<double> impulse;            // newton seconds, sum of all normal impulses of the step
  std::vector<std::vector<IdState>> ids;  // a row an id, in the order of appearance
};

/// From a whole sequence: one series a label, or one of all pairs where none has a label. Bodies
/// that touch nothing count in every series.
std::vector<TimeSeries> time_series(const std::vector<trace::Frame>& frames);

}  // namespace contactscope::draw
