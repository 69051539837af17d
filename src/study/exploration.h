#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenario/scenario.h"
#include "trace/exploration.h"

namespace contactscope {

struct ExploreOptions {
  std::vector<std::string> reducers;  // names; empty: every one that is listed
  bool measure_time = true;
};

/// Runs every reducer on the unreduced manifolds of frames 0 to `last_frame` of a scenario, in its
/// scalar, with each pair's own max_points. One entry for each frame, pair that touches, and of a
/// mesh each triangle that does, frames in order; reducers in the order asked for. A reducer that
/// goes by the frame before is given its own answer there. Of pairs of the same shapes that differ
/// in the reducer alone the first stands for all, without its label unless others of the same
/// shapes are left. The weight of the body on top goes straight down through its centre of mass,
/// and is supported by what is kept of all manifolds of the pair together.
///
/// Times are of single calls with the input at hand, all reducers in turn, so that what else the
/// machine does falls on all of them.
std::vector<trace::Exploration> explore(const Scenario& scenario, int last_frame,
                                        const ExploreOptions& options);

/// One row of the table over all frames and pairs.
struct ReducerSummary {
  std::string name;
  double mean_area_ratio = 1;
  double worst_area_ratio = 1;
  double mean_wrench_error = 0;
  double worst_wrench_error = 0;
  double worst_depth_error = 0;  // metres
  double deepest_kept = 1;       // share of the frames
  double supported = 1;          // share of the frames in which the centre of mass is
  int ids_changed = 0;           // over the sequence
  /// Metres that the patch moved from one frame to the next over metres that the bodies did, at
  /// most. Infinite where a patch moved on bodies at rest, empty where nothing ever moved.
  std::optional<double> moves;
  double median = 0;   // nanoseconds, over the frames; 0 when not measured
  double quarter = 0;  // the median of the upper quartiles
  double min = 0;
};

/// Least error first: by mean area ratio, then by wrench error, then by name.
std::vector<ReducerSummary> summarize(const std::vector<trace::Exploration>& explorations);

}  // namespace contactscope
