#pragma once

#include "geometry/mesh.h"

/// Triangles of a mesh without an area: segments and points, which collide as such. A mesh that
/// deforms, or is rounded to float, may come to have some.
namespace contactscope {

template <class S>
bool has_area(const Mesh<S>& mesh, int triangle) {
  return !mesh.normal(triangle).isZero(S(0));
}

/// The longest edge of a triangle: all of one that has no area.
template <class S>
int longest_edge(const Mesh<S>& mesh, int triangle) {
  const auto squared = [&](int k) {
    return Vec3<S>(mesh.corner(triangle, (k + 1) % 3) - mesh.corner(triangle, k)).squaredNorm();
  };
  const int of_two = squared(1) > squared(0) ? 1 : 0;
  return squared(2) > squared(of_two) ? 2 : of_two;
}

/// Like build_mesh(), but triangles without an area are kept: every triangle has the index that it was given with.
Mesh<double> build_mesh_with_flat_triangles(std::vector<Vec3d> vertices,
                                            std::vector<std::array<int, 3>> triangles,
                                            MeshReport* report = nullptr);

}  // namespace contactscope
