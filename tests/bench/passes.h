#pragma once

/// One pass over all pairs of a workload, by index; moving pairs go one step further with each.
/// Each namespace holds its own copy of the pipeline: `contactscope` as it is, `contactscope_bare`
/// the same sources compiled with the namespace renamed and without a recorder. Each returns a
/// number that depends on all results.
namespace contactscope::bench {
/// Moving pairs have a cache each.
double pass_unrecorded(int workload);
double pass_recorded(int workload);
/// Without caches.
double pass_cold(int workload);
}  // namespace contactscope::bench

namespace contactscope_bare::bench {
double pass_unrecorded(int workload);
}  // namespace contactscope_bare::bench
