#pragma once

#include <string>

#include "trace/json.h"

namespace contactscope::versus {

/// A trace with the shapes, poses and pairs of another, and no contacts: what an engine is asked. Pairs that
/// are there several times, with different settings of this program, are asked once; those that are asked
/// something else than their contacts are left out.
trace::Trace request_of(const trace::Trace& whole);

/// As JSON lines.
std::string to_text(const trace::Trace& trace);

}  // namespace contactscope::versus
