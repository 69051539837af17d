#pragma once

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
  TriangleHull();
  void set(const Mesh<S>& mesh, int triangle);

  Hull<S> hull;
  Vec3<S> origin;  // of the hull's frame, in the mesh's frame, metres
};

}  // namespace contactscope
