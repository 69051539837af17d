#pragma once

#include "bench/workload.h"
#include "support/pair_case.h"

namespace contactscope::bench {

/// One pair of W1 to W4, at the origin; `index` is the number of pairs before it.
test::PairCase<double> draw_hulls(Workload workload, test::Random& random, std::size_t index);

}  // namespace contactscope::bench
