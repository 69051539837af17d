#pragma once

#include "geometry/hull.h"
#include "geometry/mesh.h"

namespace contactscope {

/// The faces of a hull as triangles, fronts outside, in the order of the faces; its own frame, metres.
/// Vertices keep their numbers. Throws ShapeError where none has an area.
Mesh<double> surface_of(const Hull<double>& hull);

}  // namespace contactscope
