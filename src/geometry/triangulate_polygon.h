#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/vec3.h"

namespace contactscope {

/// Cuts a polygon, convex or not, into corners.size() - 2 triangles that run around the same way:
/// indices into `corners`, of which there are at least three. The polygon should be nearly flat and
/// not cross itself; what does not keep to that still gets that many triangles, which may overlap.
/// Corners that lie on a line give no triangle of zero area as long as another cut is left. Depends
/// on nothing but the shape: not on place or scale. O(n^2).
///
/// Source: ear clipping, Meisters 1975, "Polygons have ears".
std::vector<std::array<int, 3>> triangulate_polygon(std::span<const Vec3d> corners);

}  // namespace contactscope
