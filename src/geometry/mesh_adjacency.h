#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/mesh.h"

namespace contactscope {

/// Which triangle lies across which edge: Mesh::neighbours of these triangles. Vertices with equal
/// coordinates count as one. Edges that are not shared by just two triangles that run along it
/// opposite ways are reported, in the order of their first triangle and edge. O(n log n).
std::vector<std::array<int, 3>> find_neighbours(std::span<const Vec3d> vertices,
                                                std::span<const std::array<int, 3>> triangles,
                                                MeshReport& report);

/// Class of every edge, from neighbours and normals: Mesh::edges.
template <class S>
std::vector<std::array<EdgeClass, 3>> classify_edges(const Mesh<S>& mesh);

}  // namespace contactscope
