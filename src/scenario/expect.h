#pragma once

#include <string>
#include <vector>

#include "scenario/scenario.h"
#include "trace/trace.h"

namespace contactscope {

/// What of the scenario's expectations this frame does not meet: one sentence each, such as
/// "scenarios/hull/a.toml:31: frame 12, crate-floor: expected 4 points, got 2". Empty when all hold.
std::vector<std::string> unmet_expectations(const Scenario& scenario, const trace::Frame& frame);

}  // namespace contactscope
