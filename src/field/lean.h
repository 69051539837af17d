#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace contactscope {

/// How far the way from a point to its nearest point on a surface may lean from the normal of the triangle
/// that has that point: for each triangle the tangent of the largest angle;
/// kAnyLean where nothing is known.
///
/// Inside a triangle the way is along its normal. On an edge it is between the normals of both triangles.
/// At a vertex v the way d makes no acute angle with an edge there, d.e <= 0: the normal cone of v. Let m
/// be the mean of the normals around v. If all edges are within an angle a of the plane across m, and
/// neighbouring ones, seen along m, within an angle g < 180 degrees, then some edge is no farther than g/2
/// from the part of d across m, and d.e <= 0 leaves an angle b between d and m only for which
///
///     tan b  <=  tan a / cos(g/2).
///
/// That is small where triangles approximate something smooth. It needs neighbours all around each vertex;
/// a triangle without has kAnyLean.
std::vector<float> largest_leans(const Mesh<double>& mesh);

inline constexpr float kAnyLean = 1e9F;

}  // namespace contactscope
