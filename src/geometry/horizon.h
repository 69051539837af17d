#pragma once

#include <vector>

#include "geometry/quickhull_mesh.h"

namespace contactscope::quickhull {

/// What a point sees of the hull.
struct Horizon {
  std::vector<int> visible;  // faces
  std::vector<int> edges;    // boundary of those, counter-clockwise, each of a visible face
};

/// Faces that `eye` is above by more than `tolerance`, as far as they hang together with `face`,
/// which it is above, and the one loop of edges around them. Tolerance can leave the visible faces
/// with holes, or touching themselves at a vertex; the faces in the way are then taken as visible
/// too (the cone's faces are merged anyway), so that a cone over the loop always closes the mesh.
/// Empty when that takes all faces.
Horizon find_horizon(const Mesh& mesh, int face, int eye, double tolerance);

}  // namespace contactscope::quickhull
