#pragma once

#include "core/pose.h"
#include "geometry/aabb.h"
#include "geometry/shape.h"

namespace contactscope {

/// Box of a shape in the world, metres, rounded outwards. Each side is moved out by `margin` and by
/// the possible rounding of the narrow phase in S: if two boxes are separated, the narrow phase
/// finds a distance above both margins. For a mesh it contains the corners of the mesh's box, for a
/// plane everything below it.
template <class S> Aabb<float> world_box(const Shape<S>& shape, const Pose<S>& pose, double margin);

}  // namespace contactscope
