#pragma once

#include "core/vec3.h"

namespace contactscope {

/// Area in square metres of the convex hull of `points`, seen along unit `normal`.
double convex_area(std::span<const Vec3d> points, const Vec3d& normal);

/// The largest such area of any `max_points` points, up to rounding: the reference for reducers.
double best_convex_area(std::span<const Vec3d> points, const Vec3d& normal, int max_points);

}  // namespace contactscope
