#pragma once

#include <span>
#include <vector>

#include "core/vec3.h"

namespace contactscope {

/// The convex polygon of points that lie within `tolerance` (metres) of one plane, and not all
/// within it of one line: indices of its corners, counter-clockwise seen from one side. Corners that
/// lie within the tolerance of the line between their neighbours are left out. `points` are about
/// the origin, and all different.
std::vector<int> flat_outline(std::span<const Vec3d> points, double tolerance);

}  // namespace contactscope
