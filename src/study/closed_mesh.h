#pragma once

#include "geometry/mesh.h"

namespace contactscope {

/// A closed ball about the origin, poles on z, fronts outside: an even number of `meridians`, and
/// half as many steps from pole to pole. Its radius, metres, varies by the fraction `waves`, three
/// times around and twice from pole to pole.
Mesh<double> ball_mesh(int meridians, double radius = 1, double waves = 0);

/// A point and its distance from the surface of a closed mesh with fronts outside.
struct TruePoint {
  Vec3d place;
  double distance;  // metres, negative inside
  Vec3d gradient;   // of the distance, unit
};

/// By brute force over the triangles in long double. Shares no code with the tested fields.
TruePoint truth_at(const Mesh<double>& mesh, const Vec3d& place);

}  // namespace contactscope
