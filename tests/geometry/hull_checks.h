#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "geometry/hull.h"

namespace contactscope::test {

/// Every promise of Hull about topology: index ranges, twins run in opposite directions, `next`
/// closes each face's loop, every vertex has at least three edges and every face at least three
/// vertices, Euler; and the lanes match its vertices and planes.
::testing::AssertionResult is_sound(const Hull<double>& hull);

/// Planes are unit and face outward; outlines are counter-clockwise and convex; a face's vertices
/// are within `tolerance` of its plane, and no vertex is above any plane by more.
::testing::AssertionResult is_convex(const Hull<double>& hull, double tolerance);

struct Measures {
  double volume = 0;
  double area = 0;
};

/// From triangle fans.
Measures measure(const Hull<double>& hull);

/// Largest difference between the support values of the hull and of the points, over `directions`.
double support_error(const Hull<double>& hull, const std::vector<Vec3d>& points,
                     const std::vector<Vec3d>& directions);

/// Vertex counts of all faces, ascending.
std::vector<int> face_sizes(const Hull<double>& hull);

}  // namespace contactscope::test
