#pragma once

#include <vector>

#include "geometry/quickhull_mesh.h"

namespace contactscope::quickhull {

/// Merges the `fresh` faces of a new cone with each other and with the faces around it, until each
/// is convex towards all of its neighbours by more than `tolerance`. Faces that changed or went,
/// fresh or not, are added to `touched`.
void merge_cone(Mesh& mesh, const std::vector<int>& fresh, double tolerance,
                std::vector<int>& touched);

/// The same over the whole mesh: a face that was settled may have a neighbour that changed later.
void merge_all(Mesh& mesh, double tolerance);

}  // namespace contactscope::quickhull
