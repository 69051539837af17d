#pragma once

#include <string>
#include <vector>

#include "scenario/scenario.h"
#include "trace/trace.h"

namespace contactscope {

/// What of the scenario's expectations this frame does not meet: one sentence each, such as
/// "scenarios/hull/a.toml:31: frame 12, crate-floor: expected 4 points, got 2". Empty when all
/// hold. Every key is judged by itself: `points` counts over all manifolds, `normal` is compared
/// component by component and `separation` with the pair's, both within the tolerance, the bound
/// included. Of a separated pair, `axis` and `normal` are those of the separating axis, which only
/// a recorded frame has. A pair that the frame lacks is not met.
std::vector<std::string> unmet_expectations(const Scenario& scenario, const trace::Frame& frame);

}  // namespace contactscope
