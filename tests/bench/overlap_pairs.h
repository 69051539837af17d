#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/obb.h"

namespace contactscope::bench {

struct BoxPair {
  Obb<float> a, b;
  double gap;       // metres, in long double over all axes: above 0 where they are apart
  double rounding;  // metres: gaps of up to this much are float's
};

/// Boxes with sides of 0.2 to 2 m at any rotation; every tenth pair has one rotation but for 1e-7
/// rad. Half of all pairs overlap, about.
std::vector<BoxPair> overlap_pairs(int count);

using OverlapPass =
    std::function<void(const std::vector<BoxPair>& pairs, std::vector<char>& answers)>;

/// Tests of other libraries, prepared for these pairs; none in a build without them.
std::vector<std::pair<std::string, OverlapPass>> peer_passes(const std::vector<BoxPair>& pairs);

}  // namespace contactscope::bench
