#include "support/sphere_mesh.h"

#include <cmath>
#include <numbers>

namespace contactscope::test {
namespace {

SpherePair sphere_pair(double waves, const Pose<double>& b_in_a) {
  return {built(sphere_mesh(1, 110, 44, waves)), built(sphere_mesh(1, 110, 44, -waves)), b_in_a};
}

Quatd some_rotation() { return Quatd(Eigen::AngleAxisd(0.7, Vec3d(1, 2, 3).normalized())); }

}  // namespace

SphereMesh sphere_mesh(double radius, int meridians, int parallels, double waves) {
  SphereMesh mesh;
  for (int p = 1; p <= parallels; ++p) {
    const double polar = std::numbers::pi * p / (parallels + 1);
    for (int m = 0; m < meridians; ++m) {
      const double around = 2 * std::numbers::pi * m / meridians;
      const double swelling = 1 + waves * std::sin(3 * around) * std::sin(2 * polar);
      mesh.vertices.push_back(radius * swelling *
                              Vec3d(std::sin(polar) * std::cos(around),
                                    std::sin(polar) * std::sin(around), std::cos(polar)));
    }
  }
  const int north = meridians * parallels, south = north + 1;
  mesh.vertices.emplace_back(0, 0, radius);
  mesh.vertices.emplace_back(0, 0, -radius);
  for (int m = 0; m < meridians; ++m) {
    const int next = (m + 1) % meridians, last = (parallels - 1) * meridians;
    mesh.triangles.push_back({north, m, next});
    for (int row = 0; row < last; row += meridians) {
      mesh.triangles.push_back({row + m, row + meridians + m, row + next});
      mesh.triangles.push_back({row + next, row + meridians + m, row + meridians + next});
    }
    mesh.triangles.push_back({last + m, south, last + next});
  }
  return mesh;
}

Mesh<double> built(const SphereMesh& sphere) {
  return build_mesh(sphere.vertices, sphere.triangles);
}

Mesh<double> cube_mesh(double half_side) {
  const auto corner = [half_side](int i) -> Vec3d {
    return half_side * Vec3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  };
  std::vector<Vec3d> vertices;
  for (int i = 0; i < 8; ++i) vertices.push_back(corner(i));
  return build_mesh(vertices, {{0, 2, 3},
                               {0, 3, 1},
                               {4, 5, 7},
                               {4, 7, 6},
                               {0, 1, 5},
                               {0, 5, 4},
                               {2, 6, 7},
                               {2, 7, 3},
                               {0, 4, 6},
                               {0, 6, 2},
                               {1, 3, 7},
                               {1, 7, 5}});
}

SpherePair crossing_spheres() { return sphere_pair(0, {some_rotation(), Vec3d(0.9, 0.6, 0.53)}); }

SpherePair concentric_spheres() { return sphere_pair(0.1, {some_rotation(), Vec3d::Zero()}); }

}  // namespace contactscope::test
