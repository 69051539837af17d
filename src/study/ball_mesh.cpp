#include "study/ball_mesh.h"

#include <array>
#include <cmath>
#include <numbers>

#include "core/at.h"

namespace contactscope {

Mesh<double> ball_mesh(int meridians, double radius, double waves) {
  const int parallels = meridians / 2;
  std::vector<Vec3d> vertices = {{0, 0, radius}};
  for (int i = 1; i < parallels; ++i) {
    const double polar = std::numbers::pi * i / parallels;
    for (int k = 0; k < meridians; ++k) {
      const double around = 2 * std::numbers::pi * k / meridians;
      const double out = radius * (1 + waves * std::sin(3 * around) * std::sin(2 * polar));
      vertices.emplace_back(out * std::sin(polar) * std::cos(around),
                            out * std::sin(polar) * std::sin(around), out * std::cos(polar));
    }
  }
  vertices.emplace_back(0, 0, -radius);
  const int last = count_of(vertices) - 1;
  std::vector<std::array<int, 3>> triangles;
  for (int k = 0; k < meridians; ++k) {
    const int next = (k + 1) % meridians;
    triangles.push_back({0, 1 + k, 1 + next});
    for (int i = 1; i + 1 < parallels; ++i) {
      const int row = 1 + (i - 1) * meridians, below = row + meridians;
      triangles.push_back({row + k, below + k, below + next});
      triangles.push_back({row + k, below + next, row + next});
    }
    const int row = last - meridians;
    triangles.push_back({last, row + next, row + k});
  }
  return build_mesh(std::move(vertices), std::move(triangles));
}

}  // namespace contactscope
