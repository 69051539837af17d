#pragma once

#include <array>
#include <span>

#include "core/vec3.h"
#include "geometry/quickhull.h"

namespace contactscope::quickhull {

struct Simplex {
  Status status = Status::Done;  // or Coincident, Collinear, Coplanar
  std::array<int, 4> points{};   // face 0, 1, 2 is counter-clockwise seen from outside
  double thickness = 0;          // distance of the fourth point from that face
};

/// Four points that span a large tetrahedron, after Gregorius, "Implementing Quickhull": the two
/// extreme points along the axes that are farthest apart, the point farthest from their line, and
/// the point farthest from the plane of the three. Where a step finds nothing farther than
/// `tolerance`, the points have no volume, and the step says which kind of flat they are.
Simplex initial_simplex(std::span<const Vec3d> points, double tolerance);

}  // namespace contactscope::quickhull
