#pragma once

#include "geometry/quickhull_mesh.h"

namespace contactscope::quickhull {

/// A corner of a face that turns inwards.
struct Notch {
  int edge = -1;     // of the face, leaving the corner; -1 for a face without corners to look at
  double depth = 0;  // how far the corner is inside the line between its neighbours
};

/// The corner that is farthest inside; its depth is negative or 0 for a convex outline.
Notch deepest_notch(const Mesh& mesh, int face);

/// Cuts faces at corners that turn inwards by more than `tolerance`, until no outline has any.
void split_notched_faces(Mesh& mesh, double tolerance);

}  // namespace contactscope::quickhull
