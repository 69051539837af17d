#include "support/sphere_mesh.h"

#include <cmath>
#include <numbers>

namespace contactscope::test {
namespace {

SpherePair sphere_pair(double waves, const Pose<double>& b_in_a) {
  const SphereMesh a = sphere_mesh(1, 110, 44, waves), b = sphere_mesh(1, 110, 44, -waves);
  return {build_mesh(a.vertices, a.triangles), build_mesh(b.vertices, b.triangles), b_in_a};
}

Quatd some_rotation() {
  return Quatd(Eigen::AngleAxisd(0.7, Vec3d(1, 2, 3).normalized()));
}

}  // namespace

SphereMesh sphere_mesh(double radius, int meridians, int parallels, double waves) {
  SphereMesh mesh;
  for (int p = 1; p <= parallels; ++p) {
    const double polar = std::numbers::pi * p / (parallels + 1);
    for (int m = 0; m < meridians; ++m) {
      const double around = 2 * std::numbers::pi * m / meridians;
      const double swelling = 1 + waves * std::sin(5 * around) * std::sin(4 * polar);
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

SpherePair crossing_spheres() {
  return sphere_pair(0, {some_rotation(), Vec3d(0.9, 0.6, 0.53)});
}

SpherePair concentric_spheres() {
  return sphere_pair(0.02, {some_rotation(), Vec3d::Zero()});
}

}  // namespace contactscope::test
