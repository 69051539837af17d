#include "geometry/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "geometry/mesh_adjacency.h"

namespace contactscope {
namespace {

// Rounding the coordinates of a triangle, at most half a unit of 2^-52 of the largest each, moves
// its height over the longest edge by at most sqrt(3) of them. With 128 of them left, its normal
// turns by less than 0.8 degrees; kFlatEdgeAngle is one.
constexpr double kLeastHeight = 128 * std::numeric_limits<double>::epsilon();

void require_finite(const std::vector<Vec3d>& vertices) {
  Aabb<double> bounds;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!vertices[i].allFinite()) {
      throw MeshError(MeshProblem::NotFinite,
                      "vertex " + std::to_string(i) +
                          " has a coordinate that is not a finite number; give three finite ones");
    }
    bounds.include(vertices[i]);
  }
  if (!vertices.empty() && !bounds.extent().allFinite()) {
    throw MeshError(MeshProblem::NotFinite,
                    "the mesh is larger than a number can say; scale it down to metres");
  }
}

void require_vertices(const std::vector<std::array<int, 3>>& triangles, std::size_t vertex_count) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const int vertex : triangles[i]) {
      if (vertex >= 0 && static_cast<std::size_t>(vertex) < vertex_count) continue;
      throw MeshError(MeshProblem::NoSuchVertex,
                      "triangle " + std::to_string(i) + " names vertex " + std::to_string(vertex) +
                          ", but there are " + std::to_string(vertex_count) + ", counted from 0");
    }
  }
}

std::vector<int> vertices_not_in(const std::vector<std::array<int, 3>>& triangles,
                                 std::size_t vertex_count) {
  std::vector<bool> used(vertex_count, false);
  for (const std::array<int, 3>& triangle : triangles) {
    for (const int vertex : triangle) used[static_cast<std::size_t>(vertex)] = true;
  }
  std::vector<int> unused;
  for (std::size_t i = 0; i < vertex_count; ++i) {
    if (!used[i]) unused.push_back(static_cast<int>(i));
  }
  return unused;
}

template <class S>
Vec3d normal_of(const Mesh<S>& mesh, int triangle) {
  return triangle_normal(mesh.corner(triangle, 0).template cast<double>(),
                         mesh.corner(triangle, 1).template cast<double>(),
                         mesh.corner(triangle, 2).template cast<double>());
}

}  // namespace

Vec3d triangle_normal(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double largest =
      std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()});
  const std::array<Vec3d, 3> edges{b - a, c - b, a - c};
  const std::array<double, 3> lengths{edges[0].stableNorm(), edges[1].stableNorm(),
                                      edges[2].stableNorm()};
  const std::size_t longest =
      static_cast<std::size_t>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
  if (!(lengths[longest] > 0)) return Vec3d::Zero();
  // The two others: rounding grows with the product of their lengths, and the area stays what it
  // is. One scale for both keeps squares from under- and overflowing.
  const Vec3d before = edges[(longest + 1) % 3] / lengths[longest];
  const Vec3d after = edges[(longest + 2) % 3] / lengths[longest];
  const Vec3d normal = before.cross(after);
  const double height = normal.norm();  // over the longest edge, in lengths of it
  if (!(height * lengths[longest] > kLeastHeight * largest)) return Vec3d::Zero();
  return normal / height;
}

Mesh<double> build_mesh(std::vector<Vec3d> vertices, std::vector<std::array<int, 3>> triangles,
                        MeshReport* report) {
  MeshReport ignored;
  MeshReport& found = report != nullptr ? *report : ignored;
  found = {};
  require_finite(vertices);
  require_vertices(triangles, vertices.size());

  Mesh<double> mesh;
  mesh.vertices = std::move(vertices);
  mesh.triangles = std::move(triangles);
  std::size_t kept = 0;
  for (int i = 0; i < mesh.triangle_count(); ++i) {
    const Vec3d normal = normal_of(mesh, i);
    if (normal.isZero(0)) {
      found.zero_area_triangles.push_back(i);
      continue;
    }
    mesh.normals.push_back(normal);
    mesh.triangles[kept++] = mesh.triangles[static_cast<std::size_t>(i)];
  }
  if (kept == 0) {
    throw MeshError(MeshProblem::NoTriangle,
                    mesh.triangles.empty()
                        ? "the mesh has no triangle; give at least one"
                        : "every triangle of the mesh has zero area; give one whose corners are "
                          "not on a line");
  }
  mesh.triangles.resize(kept);
  found.unused_vertices = vertices_not_in(mesh.triangles, mesh.vertices.size());
  mesh.neighbours = find_neighbours(mesh.vertices, mesh.triangles, found);
  mesh.edges = classify_edges(mesh);

  std::vector<Aabb<double>> boxes;
  boxes.reserve(kept);
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    boxes.push_back(box_of<double>(mesh.vertices, triangle));
  }
  mesh.tree = build_aabb_tree(boxes);
  return mesh;
}

template <class T>
Mesh<T> mesh_cast(const Mesh<double>& mesh) {
  Mesh<T> cast;
  cast.vertices.reserve(mesh.vertices.size());
  for (const Vec3d& vertex : mesh.vertices) cast.vertices.push_back(vertex.cast<T>());
  cast.triangles = mesh.triangles;
  cast.neighbours = mesh.neighbours;
  cast.edges = mesh.edges;
  cast.normals.reserve(mesh.normals.size());
  for (int i = 0; i < mesh.triangle_count(); ++i) {
    const Vec3d normal = normal_of(cast, i);
    const bool agrees = normal.dot(mesh.normal(i)) > 0;
    cast.normals.push_back((agrees ? normal : mesh.normal(i)).template cast<T>());
  }
  cast.tree = aabb_tree_cast<T>(mesh.tree);
  return cast;
}

template <class S>
void refit(Mesh<S>& mesh) {
  for (int i = 0; i < mesh.triangle_count(); ++i) {
    const Vec3d normal = normal_of(mesh, i);
    if (!normal.isZero(0)) mesh.normals[static_cast<std::size_t>(i)] = normal.template cast<S>();
  }
  mesh.edges = classify_edges(mesh);
  mesh.tree.refit(mesh.vertices, mesh.triangles);
}

template Mesh<float> mesh_cast(const Mesh<double>&);
template Mesh<double> mesh_cast(const Mesh<double>&);
template void refit(Mesh<float>&);
template void refit(Mesh<double>&);

}  // namespace contactscope
