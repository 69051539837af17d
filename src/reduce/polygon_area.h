#pragma once

#include "core/vec3.h"

namespace contactscope {

/// Area in square metres of the convex hull of `points`, seen along unit `normal`. 0 for fewer than
/// three points or points on one line.
double convex_area(std::span<const Vec3d> points, const Vec3d& normal);

/// The largest such area of any `max_points` of the points, the reference for reducers. Exact up to
/// rounding.
double best_convex_area(std::span<const Vec3d> points, const Vec3d& normal, int max_points);

}  // namespace contactscope
