#pragma once

#include <string>

#include "trace/json.h"

namespace contactscope::versus {

/// Leaves the pairs that engines are asked: of those that are there several times, with different settings of
/// this program, the first; none that is asked something else than its contacts.
void keep_queried_pairs(trace::Frame& frame);

/// A trace with the shapes, poses and pairs of another, and no contacts: what an engine is asked.
trace::Trace request_of(const trace::Trace& whole);

/// As JSON lines.
std::string to_text(const trace::Trace& trace);

}  // namespace contactscope::versus
