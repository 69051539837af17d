#pragma once

#include <vector>

#include "find/expression.h"
#include "trace/pair.h"

namespace contactscope::find {

/// A quantity of a pair in one frame, and how it follows from the facts.
struct PairQuantity : Quantity {
  Value (*of)(const trace::Pair& pair) = nullptr;
};

/// All of them: "points", "separation", ... They are known of touching and of separated pairs,
/// except where unknown or empty.
const std::vector<PairQuantity>& pair_quantities();

/// Metres, 0 without overlap.
double overlap_of(const trace::Pair& pair);
/// Newton seconds along the normals, over all points.
double impulse_of(const trace::Pair& pair);
int point_count(const trace::Pair& pair);

}  // namespace contactscope::find
