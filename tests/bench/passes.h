#pragma once

/// One pass over all pairs of a workload, by index; moving pairs go one step further with each.
/// Each returns a number that depends on all results.
namespace contactscope::bench {
/// Moving pairs have a cache each.
double pass_unrecorded(int workload);
double pass_recorded(int workload);
/// Without caches.
double pass_cold(int workload);
/// Two hulls by what any two hulls can: what a path of its own for boxes is measured against.
double pass_general(int workload);
}  // namespace contactscope::bench
