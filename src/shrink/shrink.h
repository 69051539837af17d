#pragma once

#include <functional>

#include "shrink/judge.h"
#include "shrink/pair_of_two.h"

namespace contactscope::shrink {

struct Shrunk {
  PairOfTwo pair;
  int tried = 0;  // pairs that were judged
};

/// The smallest pair that can be had of one for which the judge says that it holds. Zeller and Hildebrandt 2002,
/// "Simplifying and Isolating Failure-Inducing Input", ddmin: parts are left out, halves first and then ever
/// smaller ones, as long as what is looked for stays. Here in this order, until a whole round finds nothing:
///
/// 1. vertices of hulls, triangles of meshes, claimed points; a box becomes a hull where that has fewer;
/// 2. keys of the pipeline;
/// 3. places: a at the origin and not turned, b not turned;
/// 4. numbers: to one digit, two, ... all at once, then each by itself.
///
/// Every step that is kept has fewer vertices, or as many and fewer claims, keys or digits, so that it ends; nothing
/// is random, and the same pair gives the same result. `progress` is called after each step that was kept.
Shrunk shrink(const PairOfTwo& start, Judge& judge,
              const std::function<void(const PairOfTwo&)>& progress = {});

}  // namespace contactscope::shrink
