#pragma once

#include "geometry/lanes.h"
#include "geometry/mesh.h"

namespace contactscope {

/// A mesh triangle as a hull, so that it collides like one: three vertices, three edges, and two
/// faces back to back, 0 the front and 1 the back. It has no volume; its centroid is the
/// triangle's. Create it once and set it to one triangle after another, without allocations.
///
/// Its frame: the mesh's axes at corner 0, so coordinates stay small however large the mesh is.
template <class S> struct TriangleHull {
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
    // The layout of lay_out().
    hull.lanes.vertices.assign(3 * kStride, S(0));
    hull.lanes.normals.assign(3 * kStride, S(0));
    hull.lanes.offsets.assign(kStride, std::numeric_limits<S>::infinity());
    hull.lanes.offsets[0] = hull.lanes.offsets[1] = S(0);
  }

  void set(const Mesh<S>& mesh, int triangle) {
    set(mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2),
        mesh.normal(triangle));
  }
  /// `normal` is a unit vector, to the side from which the corners run counter-clockwise.
  void set(const Vec3<S>& v0, const Vec3<S>& v1, const Vec3<S>& v2, const Vec3<S>& normal) {
    origin = v0;
    hull.vertices[1] = v1 - v0;
    hull.vertices[2] = v2 - v0;
    hull.planes[0] = {normal, S(0)};
    hull.planes[1] = {Vec3<S>(-normal), S(0)};
    hull.centroid = (hull.vertices[1] + hull.vertices[2]) / S(3);
    S squared = S(0);
    for (const Vec3<S>& vertex : hull.vertices)
      squared = std::max(squared, Vec3<S>(vertex - hull.centroid).squaredNorm());
    hull.radius = std::sqrt(squared);
    // The lanes of corner 0 and of the padding do not change.
    for (std::size_t k = 0; k < 3; ++k) {
      const int axis = static_cast<int>(k);
      hull.lanes.vertices[k * kStride + 1] = hull.vertices[1][axis];
      hull.lanes.vertices[k * kStride + 2] = hull.vertices[2][axis];
      hull.lanes.normals[k * kStride] = normal[axis];
      hull.lanes.normals[k * kStride + 1] = -normal[axis];
    }
  }

  static constexpr std::size_t kStride = padded(3);  // stride of the lanes; equals padded(2)

  Hull<S> hull;
  Vec3<S> origin;  // origin of the hull's frame in the mesh's frame, metres
};

}  // namespace contactscope
