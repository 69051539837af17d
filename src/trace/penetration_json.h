#pragma once

#include "trace/json_values.h"
#include "trace/read_node.h"
#include "trace/trace.h"

/// Facts in the Minkowski difference as JSON, and back. Reading throws Complaint.
namespace contactscope::trace {

/// [{"a": point of a, "b": point of b}, ..]
Json simplex(const Simplex& s);
Simplex read_simplex(const Node& node);

/// "polytopes", "portals" and "directions" are keys of their own method alone, and "fallback" one
/// of a method that had to leave the answer to another.
Json penetration(const Penetration& p);
Penetration read_penetration(const Node& node);

Json minkowski(const Minkowski& m);
Minkowski read_minkowski(const Node& node);

}  // namespace contactscope::trace
