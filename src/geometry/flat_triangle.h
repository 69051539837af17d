#pragma once

#include "geometry/mesh.h"

/// Mesh triangles without area. They collide as segments and points. A mesh can get them by
/// deformation or by rounding to float.
namespace contactscope {

template <class S>
bool has_area(const Mesh<S>& mesh, int triangle) {
  return !mesh.normal(triangle).isZero(S(0));
}

/// Index of the longest edge. For a triangle without area it is the whole triangle.
template <class S>
int longest_edge(const Mesh<S>& mesh, int triangle) {
  const auto squared = [&](int k) {
    return Vec3<S>(mesh.corner(triangle, (k + 1) % 3) - mesh.corner(triangle, k)).squaredNorm();
  };
  const int of_two = squared(1) > squared(0) ? 1 : 0;
  return squared(2) > squared(of_two) ? 2 : of_two;
}

/// Like build_mesh(), but keeps triangles without area, so the indices of the input stay valid.
Mesh<double> build_mesh_with_flat_triangles(std::vector<Vec3d> vertices,
                                            std::vector<std::array<int, 3>> triangles,
                                            MeshReport* report = nullptr);

}  // namespace contactscope
