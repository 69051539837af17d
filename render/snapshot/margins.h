#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "trace/decision.h"

namespace contactscope::snapshot {

/// Margins of the pipeline's decisions, by frame and pair ("crate-floor"). They are not stored:
/// each run computes them, and changes are reported with the current ones.
using Margins = std::map<std::pair<int, std::string>, std::vector<trace::Decision>>;

}  // namespace contactscope::snapshot
