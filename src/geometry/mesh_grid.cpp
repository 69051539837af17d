#include "geometry/mesh_grid.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

namespace contactscope {
namespace {

constexpr double kWaves = 3;  // along each side

void require_size(const char* name, double value) {
  if (std::isfinite(value) && value > 0) return;
  std::ostringstream message;
  message << name << " is " << value << "; it must be a finite length above 0";
  throw ShapeError(message.str());
}

void require_cells(int cells_x, int cells_z) {
  // Division: a product of two ints may not fit.
  if (cells_x > 0 && cells_z > 0 && cells_x <= kMaxGridCells / cells_z) return;
  throw ShapeError("the grid has " + std::to_string(cells_x) + " by " + std::to_string(cells_z) +
                   " cells; give at least 1 along each side and at most " +
                   std::to_string(kMaxGridCells) + " together");
}

/// Line i of `cells` + 1, as a part of the side: -1/2 to 1/2, exact at both ends and symmetric.
double part(int i, int cells) {
  return (2.0 * i - cells) / (2.0 * cells);
}

}  // namespace

Mesh<double> make_grid(double size_x, double size_z, int cells_x, int cells_z, double amplitude) {
  require_size("size_x", size_x);
  require_size("size_z", size_z);
  require_cells(cells_x, cells_z);
  if (!std::isfinite(amplitude))
    throw ShapeError("the amplitude is not a finite number; give a length in metres");
  constexpr double kTurn = 2 * std::numbers::pi * kWaves;
  std::vector<Vec3d> vertices;
  for (int j = 0; j <= cells_z; ++j) {
    const double z = part(j, cells_z);
    for (int i = 0; i <= cells_x; ++i) {
      const double x = part(i, cells_x);
      const double y = amplitude * std::sin(kTurn * x) * std::cos(kTurn * z);
      vertices.emplace_back(size_x * x, y, size_z * z);
    }
  }
  std::vector<std::array<int, 3>> triangles;
  for (int j = 0; j < cells_z; ++j) {
    for (int i = 0; i < cells_x; ++i) {
      const int corner = i + (cells_x + 1) * j;
      const int across = corner + cells_x + 2;
      triangles.push_back({corner, across - 1, corner + 1});
      triangles.push_back({across, corner + 1, across - 1});
    }
  }
  return build_mesh(std::move(vertices), std::move(triangles));
}

}  // namespace contactscope
