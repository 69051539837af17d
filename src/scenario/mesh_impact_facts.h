#pragma once

#include "scenario/scenario.h"
#include "trace/impact.h"

namespace contactscope {

/// When two meshes first meet between `from` and `to`, seconds. Each corner moves in a straight
/// line at constant speed between its scripted positions, whether the mesh deforms, moves or turns.
/// In double, whatever the scenario's scalar. Both shapes must be meshes.
trace::Impact mesh_impact_facts(const ScenarioShape& a, const ScenarioShape& b, double from,
                                double to);

}  // namespace contactscope
