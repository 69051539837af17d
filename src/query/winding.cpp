#include "query/winding.h"

#include "geometry/predicates.h"
#include "query/mesh_overlap.h"

namespace contactscope {
namespace {

/// Side of the edge a, b on which a point moved by (e, e^2) is, in x-y; 0 for an edge along z.
int side_of_edge(const Vec3d& a, const Vec3d& b, const Vec3d& point) {
  const int side = orient2d(a, b, point, 2);
  if (side != 0) return side;
  const int by_first = predicates::sign_of(a.y() - b.y());
  return by_first != 0 ? by_first : predicates::sign_of(b.x() - a.x());
}

/// Adds a triangle's contribution to the winding number around a point.
void add_triangle(const Triangle<double>& t, const Vec3d& point, Winding& winding) {
  // 1 if the front is visible from above, so the ray leaves there.
  const int front = orient2d(t[0], t[1], t[2], 2);
  if (front == 0) {
    // Seen as a segment: the moved ray misses it. The point itself may still be on it.
    if (triangle_overlap_kind<double>(t, {point, point, point}) != TriangleOverlapKind::None)
      winding.on_surface = true;
    return;
  }
  bool crossed = true, reached = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d &from = t[k], &to = t[(k + 1) % 3];
    crossed &= side_of_edge(from, to, point) == front;
    reached &= orient2d(from, to, point, 2) * front >= 0;
  }
  if (!reached) return;
  const int side = orient3d(t[0], t[1], t[2], point);
  if (side == 0) winding.on_surface = true;
  // The triangle is above the point: the point is behind a front that faces up.
  if (crossed && side == -front) winding.number += front;
}

template <class S>
Triangle<double> triangle_in_double(const std::vector<Vec3<S>>& vertices,
                                    const std::array<int, 3>& triangle) {
  const auto corner = [&](std::size_t k) -> Vec3d {
    return at(vertices, triangle[k]).template cast<double>();
  };
  return {corner(0), corner(1), corner(2)};
}

/// The winding number without a tree.
template <class S>
Winding winding_around(const std::vector<Vec3<S>>& vertices,
                       const std::vector<std::array<int, 3>>& triangles, const Vec3<S>& point) {
  Winding winding;
  const Vec3d p = point.template cast<double>();
  for (const std::array<int, 3>& triangle : triangles)
    add_triangle(triangle_in_double(vertices, triangle), p, winding);
  return winding;
}

/// One vertex of each part of the mesh that is connected across edges.
template <class S> std::vector<int> vertex_of_each_part(const Mesh<S>& mesh) {
  std::vector<int> found, open;
  std::vector<bool> seen(mesh.triangles.size(), false);
  for (int first = 0; first < mesh.triangle_count(); ++first) {
    if (at(seen, first)) continue;
    found.push_back(at(mesh.triangles, first)[0]);
    at(seen, first) = true;
    open.push_back(first);
    while (!open.empty()) {
      const int triangle = open.back();
      open.pop_back();
      for (const int neighbour : at(mesh.neighbours, triangle)) {
        if (neighbour < 0 || at(seen, neighbour)) continue;
        at(seen, neighbour) = true;
        open.push_back(neighbour);
      }
    }
  }
  return found;
}

}  // namespace

template <class S> Winding winding_number(const Mesh<S>& mesh, const Vec3<S>& point) {
  Winding winding;
  const Vec3d p = point.template cast<double>();
  Aabb<S> above;
  above.include(point);
  above.upper.z() = std::numeric_limits<S>::infinity();
  mesh.tree.query(above, [&](int triangle) {
    add_triangle(triangle_in_double(mesh.vertices, at(mesh.triangles, triangle)), p, winding);
  });
  return winding;
}

template <class S> std::vector<MeshEdge> open_edges(const Mesh<S>& mesh) {
  std::vector<MeshEdge> open;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      if (mesh.neighbour(t, k) < 0) open.push_back({t, k});
  return open;
}

template <class S>
Containment mesh_containment(const Mesh<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a) {
  if (!open_edges(a).empty()) return Containment::AHasHoles;
  if (!open_edges(b).empty()) return Containment::BHasHoles;
  const std::vector<Vec3<S>> vertices_b = vertices_in(b, b_in_a);
  for (const int vertex : vertex_of_each_part(b))
    if (winding_number(a, at(vertices_b, vertex)).number != 0) return Containment::BInA;
  for (const int vertex : vertex_of_each_part(a))
    if (winding_around(vertices_b, b.triangles, at(a.vertices, vertex)).number != 0)
      return Containment::AInB;
  return Containment::Separation;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(winding_number, open_edges, mesh_containment);

}  // namespace contactscope
