#pragma once

/// One pass over all pairs of a workload, by index; each pass advances moving pairs by a step. Each
/// function returns a number that depends on all results.
namespace contactscope::bench {
/// Each moving pair has a cache.
double pass_unrecorded(int workload);
double pass_recorded(int workload);
/// Without caches.
double pass_cold(int workload);
/// Each triangle of a mesh has its own manifolds.
double pass_by_triangle(int workload);
/// Without the special paths: boxes are treated as any hulls, also on a mesh and with a cache;
/// every face of large hulls is measured; two capsules take the path of all shapes.
double pass_general(int workload);
}  // namespace contactscope::bench
