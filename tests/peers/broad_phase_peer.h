#pragma once

#include <vector>

#include "study/broad_phase_study.h"

namespace contactscope::peers {

/// Broad phases of other libraries. They report each pair once; some also report near misses.
std::vector<PairFinderInfo> bullet_broad_phases();
std::vector<PairFinderInfo> fcl_broad_phases();
std::vector<PairFinderInfo> ode_broad_phases();
/// Empty if Embree is not installed.
std::vector<PairFinderInfo> embree_broad_phases();
std::vector<PairFinderInfo> broad_phase_peers();

}  // namespace contactscope::peers
