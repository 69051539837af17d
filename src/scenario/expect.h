#pragma once

#include <string>
#include <vector>

#include "scenario/scenario.h"
#include "trace/trace.h"

namespace contactscope {

/// What of the scenario's expectations these frames do not meet: one sentence for each thing, such
/// as "scenarios/hull/face_contact.toml:31: frames 12 to 14, crate-floor: expected 4 points, got 2", with what
/// the first of them got; where others got something else, it says so. Empty when all hold. Every key is judged by itself: `points` counts over all manifolds, `normal` is compared
/// component by component and `separation` with the pair's, both within the tolerance, the bound
/// included. Of a separated pair, `axis` and `normal` are those of the separating axis, which only
/// a recorded frame has. A pair that the frame lacks is not met.
std::vector<std::string> unmet_expectations(const Scenario& scenario,
                                            const std::vector<trace::Frame>& frames);

}  // namespace contactscope
