#pragma once

#include "geometry/mesh.h"

namespace contactscope {

/// A point and its distance from the surface of a closed mesh with fronts outside.
struct TruePoint {
  Vec3d place;
  double distance;  // metres, negative inside
  Vec3d gradient;   // of the distance, unit
};

/// By brute force over the triangles in long double. Shares no code with the tested fields.
TruePoint truth_at(const Mesh<double>& mesh, const Vec3d& place);

}  // namespace contactscope
