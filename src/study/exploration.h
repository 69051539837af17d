#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/manifold.h"
#include "scenario/scenario.h"
#include "trace/exploration.h"
#include "trace/json.h"

namespace contactscope {

/// How good a reduction is, whatever made it: everything of an answer but its name, whether it supports
/// the centre of mass, and what it takes several frames or a clock for. `kept` are indices into
/// `points`, which share a plane with unit `normal`.
///
/// wrench_error: a unit force along the normal resists, about an axis in the plane through the centroid
/// of all points, at most the reach of the patch across that axis, in metres; this is the largest
/// shortfall of that reach over all axes (the distance of the farthest point from the kept
/// polygon), as a fraction of the patch's radius. 0 for one point.
///
/// depth_error, metres: how far the plane that fits the kept depths best (least squares) is from the
/// depth of any point.
trace::ReducerAnswer measure_reduction(std::span<const ContactPoint<double>> points,
                                       const Vec3d& normal, std::span<const int> kept,
                                       int max_points);

/// Whether a place, seen along unit `normal`, lies in the convex hull of the kept points: an
/// upright load through it, say the weight at the centre of mass, makes nothing tip. Points within
/// rounding of the edge count as inside.
bool supports(std::span<const ContactPoint<double>> points, const Vec3d& normal,
              std::span<const int> kept, const Vec3d& place);

struct ExploreOptions {
  std::vector<std::string> reducers;  // names; empty: every one that is listed
  bool measure_time = true;
  int threads =
      0;  // of what is not timed; 0: as many as the processor runs. Answers are the same for any
  /// ReportInput of each step, in any thread, but by one at a time; may throw to stop. `what`: of which there are `total`.
  std::function<void(const std::string& what, int total)> progress{};
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

/// The same of a trace, with four points: of a pair whose reduction was recorded all points before it, of
/// others those that its engine tells.
std::vector<trace::Exploration> explore(const trace::Trace& trace, const ExploreOptions& options);

/// One row of the table over all frames and pairs.
struct ReducerSummary {
  std::string name;
  double mean_area_ratio = 1;
  double worst_area_ratio = 1;
  double mean_wrench_error = 0;
  double worst_wrench_error = 0;
  double worst_depth_error = 0;  // metres
  double deepest_kept = 1;       // share of the frames
  /// Share of the frames in which the centre of mass is; empty where there is no body.
  std::optional<double> supported{};
  int ids_changed = 0;  // over the sequence
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
