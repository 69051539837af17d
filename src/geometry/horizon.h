#pragma once

#include <vector>

#include "geometry/quickhull_mesh.h"

namespace contactscope::quickhull {

/// What a point sees of the hull.
struct Horizon {
  std::vector<int> visible;  // faces
  std::vector<int> edges;    // around those, counter-clockwise, each of a visible face
};

/// The faces that `eye` is above by more than `tolerance`, as far as they hang together with
/// `face`, which it is above, and the loop of edges around them. `edges` is empty where tolerance
/// leaves the visible faces without a boundary, with a hole or pinched at a vertex, so that no cone
/// of triangles over it would close the hull.
Horizon find_horizon(const Mesh& mesh, int face, int eye, double tolerance);

}  // namespace contactscope::quickhull
