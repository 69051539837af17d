#pragma once

#include "bench/workload.h"
#include "support/pair_case.h"

namespace contactscope::bench {

/// One pair of W1 to W4, at the origin; `index` counts the pairs so far.
test::PairCase<double> draw_hulls(Workload workload, test::Random& random, std::size_t index);

}  // namespace contactscope::bench
