#pragma once

#include <vector>

#include "broadphase/broad_phase.h"

namespace contactscope {

/// Sorts pairs of different handles below `handles` ascending, in time linear in both counts where
/// that is faster than comparing.
void sort_pairs(std::vector<BoxPair>& pairs, int handles);

}  // namespace contactscope
