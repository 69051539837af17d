#pragma once

#include "scenario/scenario.h"
#include "trace/impact.h"

namespace contactscope {

/// When two meshes first meet between `from` and `to`, seconds. Each corner goes straight on at constant
/// speed from where its script has it at one to where it has it at the other, whether the mesh deforms,
/// moves or turns. In double, whatever the scenario's scalar is. Both shapes are meshes.
trace::Impact mesh_impact_facts(const ScenarioShape& a, const ScenarioShape& b, double from,
                                double to);

}  // namespace contactscope
