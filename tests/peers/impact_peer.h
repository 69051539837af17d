#pragma once

#include <vector>

#include "study/impact_cases.h"

namespace contactscope::peers {

/// Continuous collision of other libraries, with the smallest possible margins of hulls.
std::vector<ImpactFinderInfo> bullet_impacts();
std::vector<ImpactFinderInfo> fcl_impacts();
inline std::vector<ImpactFinderInfo> impact_peers() {
  std::vector<ImpactFinderInfo> all = bullet_impacts();
  for (const ImpactFinderInfo& info : fcl_impacts()) all.push_back(info);
  return all;
}

}  // namespace contactscope::peers
