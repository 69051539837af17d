#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "trace/decision.h"

namespace contactscope::snapshot {

/// By which margins the pipeline chose, by frame and pair ("crate-floor"). Stored traces do not hold them: a run works
/// them out for itself, and what changed is told with those of now.
using Margins = std::map<std::pair<int, std::string>, std::vector<trace::Decision>>;

}  // namespace contactscope::snapshot
