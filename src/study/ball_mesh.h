#pragma once

#include "geometry/mesh.h"

namespace contactscope {

/// A closed ball about the origin, poles on z, fronts outside: an even number of `meridians`, and
/// half as many steps from pole to pole. Its radius, metres, varies by the fraction `waves`, three
/// times around and twice from pole to pole.
Mesh<double> ball_mesh(int meridians, double radius = 1, double waves = 0);

}  // namespace contactscope
