#pragma once

#include "trace/trace.h"

namespace contactscope::trace {

/// Creates ids from geometry for pairs without any, in the format of FeatureId: the two edges that
/// cross at the point, seen along the normal, or the feature of each shape that it lies on. This
/// lets points of engines without ids be tracked between frames. `shapes` must contain all shapes
/// of the frame, with faces and edges. Points on a distance field get no ids. If a mesh manifold
/// names no triangle, the mesh is searched for it, up to 20,000 triangles. True if it names any.
bool name_points(const std::vector<Shape>& shapes, Frame& frame);

}  // namespace contactscope::trace
