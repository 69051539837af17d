#pragma once

#include <string>

#include "trace/json.h"

namespace contactscope::versus {

/// Keeps the pairs to query engines for: the first of several with different settings of this
/// program, and no pair with a query other than for contacts.
void keep_queried_pairs(trace::Frame& frame);

/// A request to an engine: the shapes, poses and pairs of a trace without contacts.
trace::Trace request_of(const trace::Trace& whole);

/// This program's contacts for a request, in double with default settings, for use without a
/// scenario.
trace::Trace own_contacts(const trace::Trace& request);

/// As JSON lines.
std::string to_text(const trace::Trace& trace);

}  // namespace contactscope::versus
