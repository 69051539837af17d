#pragma once

#include <span>
#include <vector>

#include "core/vec3.h"

namespace contactscope::draw {

/// Contour line of a value on a grid. Points are in grid steps: column, row, 0.
struct Contour {
  std::vector<Vec3d> points;
  bool closed = false;
};

/// Contour lines at `level`: marching squares (after Lorensen and Cline 1987, in the plane), linear
/// between neighbours, chained from square to square. In an ambiguous square the mean of its
/// corners decides. `values`: row by row, `columns` each; fewer than two rows or columns give no
/// lines.
std::vector<Contour> contours_at(std::span<const double> values, int columns, double level);

}  // namespace contactscope::draw
