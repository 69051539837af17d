#pragma once

#include "geometry/mesh.h"

namespace contactscope {

/// Cells that a grid may have at most: four million triangles, beyond which a slip of the pen is
/// likelier than a wish.
inline constexpr int kMaxGridCells = 2'000'000;

/// Height field centred on the origin of its frame in the x-z plane, y up, metres; the front is
/// above. `size` is the whole side, cut into `cells` equal ones of two triangles each;
/// y = amplitude sin(3 tau x / size_x) cos(3 tau z / size_z), three waves along each side (tau = 2
/// pi), exactly flat for amplitude 0. Vertex i + (cells_x + 1) j is the i-th along +x in row j
/// along +z; cell i + cells_x j is triangles 2 (i + cells_x j), at the corner of least x and z, and
/// the next one.
///
/// Throws ShapeError unless sizes are positive and finite, the amplitude finite,
/// and the cells at least one along each side and kMaxGridCells together.
Mesh<double> make_grid(double size_x, double size_z, int cells_x, int cells_z, double amplitude);

}  // namespace contactscope
