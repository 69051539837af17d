#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/obb.h"

namespace contactscope::bench {

struct BoxPair {
  Obb<float> a, b;
  double gap;       // metres, in long double over all axes; positive if separated
  double rounding;  // metres: separations up to this size may be float's rounding
};

/// Boxes with sides of 0.2 to 2 m at any rotation; every tenth pair is parallel up to 1e-7 rad.
/// About half of all pairs overlap.
std::vector<BoxPair> overlap_pairs(int count);

using OverlapPass =
    std::function<void(const std::vector<BoxPair>& pairs, std::vector<char>& answers)>;

/// Tests of other libraries, prepared for these pairs; empty in a build without the libraries.
std::vector<std::pair<std::string, OverlapPass>> peer_passes(const std::vector<BoxPair>& pairs);

}  // namespace contactscope::bench
