#pragma once

#include <span>
#include <vector>

#include "core/vec3.h"

namespace contactscope::draw {

/// A line along which a value on a grid is the same. Places in steps of the grid: column, row, 0.
struct Contour {
  std::vector<Vec3d> points;
  bool closed = false;
};

/// Lines along which the values are `level`: marching squares (after Lorensen and Cline 1987, in the
/// plane), linear between neighbours, chained from square to square. Two lines that could cross in a
/// square are told apart by the mean of its corners. `values`: row by row, `columns` each, which divides
/// them; fewer than two rows or columns have none.
std::vector<Contour> contours_at(std::span<const double> values, int columns, double level);

}  // namespace contactscope::draw
