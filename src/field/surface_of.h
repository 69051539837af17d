#pragma once

#include "geometry/hull.h"
#include "geometry/mesh.h"

namespace contactscope {

/// The faces of a hull as triangles, fronts outside, in the order of the faces; its frame, metres.
/// Vertices keep their indices. Throws ShapeError if no face has an area.
Mesh<double> surface_of(const Hull<double>& hull);

}  // namespace contactscope
