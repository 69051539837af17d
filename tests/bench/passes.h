#pragma once

/// One pass over all pairs of a workload, by index; moving pairs go one step further with each.
/// Each returns a number that depends on all results.
namespace contactscope::bench {
/// Moving pairs have a cache each.
double pass_unrecorded(int workload);
double pass_recorded(int workload);
/// Without caches.
double pass_cold(int workload);
/// What the pair would take without the path of its own that it has: boxes are any hulls, also on a mesh
/// and with a cache; every face of large hulls is measured; two capsules go the way of all shapes.
double pass_general(int workload);
}  // namespace contactscope::bench
