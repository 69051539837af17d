#pragma once

#include "geometry/mesh.h"

namespace contactscope {

/// Bounds, as tangents, on how far the direction from a point to its nearest surface point leans
/// from the normal of the triangle there. One per triangle; kAnyLean if unknown.
///
/// Inside a triangle the direction is its normal. On an edge it is between the normals of both
/// triangles. At a vertex v the direction d makes no acute angle with an edge there, d.e <= 0: the
/// normal cone of v. Let m be the mean of the normals around v. Let all edges be within an angle a
/// of the plane perpendicular to m, and neighbouring ones, seen along m, within an angle g < 180
/// degrees. Then some edge is within g/2 of d's part in that plane, and d.e <= 0 limits the angle b
/// of d and m:
///
///     tan b  <=  tan a / cos(g/2).
///
/// The bound is small for triangles that approximate a smooth surface. It needs neighbours all
/// around each vertex; triangles without them have kAnyLean.
std::vector<float> largest_leans(const Mesh<double>& mesh);

inline constexpr float kAnyLean = 1e9F;

}  // namespace contactscope
