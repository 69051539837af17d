#pragma once

#include <algorithm>

#include "geometry/hull.h"
#include "geometry/mesh.h"

namespace contactscope {

/// One triangle of a mesh as a hull, so that it collides like one: three vertices, three edges, and
/// two faces back to back, 0 the front and 1 the back. It has no volume; its centroid is the
/// triangle's. Made once and set to one triangle after the other, without allocations.
///
/// Its frame has the mesh's axes and its origin at the triangle's corner 0, where coordinates are
/// small however large the mesh is.
template <class S>
struct TriangleHull {
  //        v2          half-edges of the front: 0 from v0 to v1, 2 from v1 to v2, 4 from v2 to v0;
  //       /  |         their twins 1, 3, 5 bound the back
  //      4   2
  //     /    |
  //    v0-0-v1
  TriangleHull() {
    hull.vertices.assign(3, Vec3<S>::Zero());
    hull.half_edges = {{0, 2, 0}, {1, 5, 1}, {1, 4, 0}, {2, 1, 1}, {2, 0, 0}, {0, 3, 1}};
    hull.vertex_edges = {0, 2, 4};
    hull.face_edges = {0, 1};
    hull.planes.resize(2);
  }

  void set(const Mesh<S>& mesh, int triangle) {
    origin = mesh.corner(triangle, 0);
    for (int k = 1; k < 3; ++k) at(hull.vertices, k) = mesh.corner(triangle, k) - origin;
    const Vec3<S>& normal = mesh.normal(triangle);
    hull.planes[0] = {normal, S(0)};
    hull.planes[1] = {Vec3<S>(-normal), S(0)};
    hull.centroid = (hull.vertices[1] + hull.vertices[2]) / S(3);
    hull.radius = S(0);
    for (const Vec3<S>& vertex : hull.vertices)
      hull.radius = std::max(hull.radius, Vec3<S>(vertex - hull.centroid).norm());
    lay_out(hull);
  }

  Hull<S> hull;
  Vec3<S> origin;  // of the hull's frame, in the mesh's frame, metres
};

}  // namespace contactscope
