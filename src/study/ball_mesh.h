#pragma once

#include "geometry/mesh.h"

namespace contactscope {

/// A closed ball about the origin, poles on z, fronts outside: `meridians`, even, of them around, half as
/// many steps from pole to pole. Its radius, metres, swells and shrinks by the part `waves` of it, three
/// times around and twice from pole to pole.
Mesh<double> ball_mesh(int meridians, double radius = 1, double waves = 0);

}  // namespace contactscope
