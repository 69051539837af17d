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

/// "bodies" by name, as "poses" are.
Json solver(const Solver& s);
Solver read_solver(const Node& node);

Json totals(const Totals& t);
Totals read_totals(const Node& node);

}  // namespace contactscope::trace
