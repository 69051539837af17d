#pragma once

#include <vector>

#include "study/broad_phase_study.h"

namespace contactscope::peers {

/// The broad phases of other libraries. Each pair once; some report boxes that only nearly touch.
std::vector<PairFinderInfo> bullet_broad_phases();
std::vector<PairFinderInfo> fcl_broad_phases();
std::vector<PairFinderInfo> ode_broad_phases();
/// None where Embree is not installed.
std::vector<PairFinderInfo> embree_broad_phases();
std::vector<PairFinderInfo> broad_phase_peers();

}  // namespace contactscope::peers
