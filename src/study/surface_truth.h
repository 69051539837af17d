#pragma once

#include "geometry/mesh.h"

namespace contactscope {

/// A point and how far it is from the surface of a mesh that is closed, fronts outside.
struct TruePoint {
  Vec3d place;
  double distance;  // metres, negative inside
  Vec3d gradient;   // of the distance, unit
};

/// By every triangle in long double. It shares nothing with the fields that it judges.
TruePoint truth_at(const Mesh<double>& mesh, const Vec3d& place);

}  // namespace contactscope
