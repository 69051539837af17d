#pragma once

#include <string>
#include <vector>

#include "snapshot/compare_trace.h"

namespace contactscope::snapshot {

/// The sentences of all differences; both traces stay as they are.
inline std::vector<std::string> compare_traces(const trace::Trace& expected, trace::Trace actual) {
  return compare_and_settle(expected, actual).sentences;
}

}  // namespace contactscope::snapshot
