#pragma once

#include <span>
#include <vector>

#include "core/vec3.h"

namespace contactscope::quickhull {

enum class Status {
  Done,
  Coincident,  // all points within the tolerance of one point
  Collinear,   // ... of one line
  Coplanar,    // ... of one plane
  Unresolved,  // merging left no polyhedron, or one that is not convex within kSlack tolerances
};

/// Largest distance, in tolerances, of any input point above any plane, and of a face's own
/// vertices from its plane, that counts as convex. Merged planes are fitted to points that each may
/// be a tolerance off, and the centroid test extrapolates from a face's middle to its rim.
inline constexpr double kSlack = 10;

struct Result {
  Status status = Status::Done;
  std::vector<std::vector<int>> faces;  // point indices, counter-clockwise seen from outside
};

/// Quickhull. `points` are about the origin with coordinates of magnitude 1, no two equal;
/// `tolerance` in the same unit.
Result run(std::span<const Vec3d> points, double tolerance);

}  // namespace contactscope::quickhull
