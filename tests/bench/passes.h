#pragma once

/// One pass over all pairs of a workload, by index. Each namespace holds its own copy of the
/// pipeline: `contactscope` as it is, `contactscope_bare` the same sources compiled with the
/// namespace renamed and without a recorder. Each returns a number that depends on all results.
namespace contactscope::bench {
double pass_unrecorded(int workload);
double pass_recorded(int workload);
}  // namespace contactscope::bench

namespace contactscope_bare::bench {
double pass_unrecorded(int workload);
}  // namespace contactscope_bare::bench
