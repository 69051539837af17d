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

/// Quality of a reduction by any method: all of an answer except its name, the support of the
/// centre of mass, and values that need several frames or a clock. `kept` are indices into
/// `points`, which lie in a plane with unit `normal`.
///
/// wrench_error: about an axis in the plane through the centroid of all points, the torque that a
/// unit force along the normal can resist is the patch's reach across that axis, in metres. This is
/// the largest loss of reach over all axes (the distance of the farthest point from the kept
/// polygon), as a fraction of the patch's radius. 0 for one point.
///
/// depth_error, metres: largest difference between a point's depth and the plane fitted to the kept
/// depths (least squares).
trace::ReducerAnswer measure_reduction(std::span<const ContactPoint<double>> points,
                                       const Vec3d& normal, std::span<const int> kept,
                                       int max_points);

/// Whether a point, seen along unit `normal`, is in the convex hull of the kept points: a load
/// through it along the normal, such as a weight, tips nothing. Points within rounding of the edge
/// count as inside.
bool supports(std::span<const ContactPoint<double>> points, const Vec3d& normal,
              std::span<const int> kept, const Vec3d& place);

struct ExploreOptions {
  std::vector<std::string> reducers;  // names; empty: all in the list
  bool measure_time = true;
  int threads = 0;  // for untimed work; 0: one per hardware thread. Does not affect results
  /// Called for each of `total` steps, from any thread, never concurrently; may throw to stop.
  std::function<void(const std::string& what, int total)> progress{};
};

/// Runs every reducer on the unreduced manifolds of frames 0 to `last_frame` of a scenario, in its
/// scalar, with each pair's own max_points. One entry per frame and touching pair, per triangle for
/// a mesh, frames in order; reducers in the given order. A reducer that depends on the previous
/// frame gets its own result there. Pairs that differ only in the reducer are explored once,
/// without label unless other pairs have the same shapes. The weight of the upper body acts
/// straight down through its centre of mass, supported by the kept points of all manifolds of the
/// pair.
///
/// Times are of single calls with input in cache, all reducers in turn, so that other load on the
/// machine affects all of them.
std::vector<trace::Exploration> explore(const Scenario& scenario, int last_frame,
                                        const ExploreOptions& options);

/// The same for a trace, with four points: all points before a recorded reduction, else the points
/// that the engine reports.
std::vector<trace::Exploration> explore(const trace::Trace& trace, const ExploreOptions& options);

/// One row of the table, over all frames and pairs.
struct ReducerSummary {
  std::string name;
  double mean_area_ratio = 1;
  double worst_area_ratio = 1;
  double mean_wrench_error = 0;
  double worst_wrench_error = 0;
  double worst_depth_error = 0;  // metres
  double deepest_kept = 1;       // share of the frames
  /// Share of the frames in which the centre of mass is supported; empty without bodies.
  std::optional<double> supported{};
  int ids_changed = 0;  // over the sequence
  /// Largest ratio of the patch's movement between frames to the bodies' movement. Infinite if a
  /// patch moved on resting bodies, empty if nothing ever moved.
  std::optional<double> moves;
  double median = 0;   // nanoseconds, over the frames; 0 if not measured
  double quarter = 0;  // the median of the upper quartiles
  double min = 0;
};

/// Smallest error first: by mean area ratio, then by wrench error, then by name.
std::vector<ReducerSummary> summarize(const std::vector<trace::Exploration>& explorations);

}  // namespace contactscope
