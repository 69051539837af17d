#pragma once

#include "trace/json_values.h"
#include "trace/read_node.h"
#include "trace/trace.h"

/// Facts that outlive a frame, and of the solver, as JSON, and back. Reading throws Complaint.
namespace contactscope::trace {

/// Points with their "impulse", where the solver gave one.
std::vector<Point> read_points(const Node& node);

/// Each point has the keys of a contact point, and those of what became of it.
Json incremental(const Incremental& i);
Incremental read_incremental(const Node& node);

Json stability(const Stability& s);
Stability read_stability(const Node& node);

/// Of a frame that has a solver. "bodies" by name, as "poses" are. "totals" are columns for plots, of
/// what else the frame holds, and are not read back: of all points that have an impulse the deepest
/// penetration in metres, the sum of normal impulses in newton seconds and their number; of all bodies
/// the energies in joules.
Json solver(const Frame& frame);
Solver read_solver(const Node& node);

}  // namespace contactscope::trace
