#pragma once

#include <string>
#include <vector>

#include "snapshot/changes.h"
#include "trace/trace.h"

namespace contactscope::snapshot {

/// What differs between two records of one pair, a part of a sentence each, the most telling first:
/// "point 2 moved 1.3 mm along x, separation -0.0050 -> -0.0037". Empty when nothing does. Points
/// belong together by id, else by index; names, ids and indices compare exactly.
std::vector<std::string> compare_pair(const trace::Pair& expected, const trace::Pair& actual,
                                      const Tolerance& tolerance);

}  // namespace contactscope::snapshot
