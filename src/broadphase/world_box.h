#pragma once

#include "core/pose.h"
#include "geometry/aabb.h"
#include "geometry/shape.h"

namespace contactscope {

/// Box of a shape in the world, metres, rounded outwards. Each side stands `margin` farther out, and by
/// what the narrow phase may round the same points to in S: two shapes whose boxes are apart are
/// farther apart than both margins to it, too. Of a mesh it is around the corners of its own box,
/// of a plane everything below it.
template <class S>
Aabb<float> world_box(const Shape<S>& shape, const Pose<S>& pose, double margin);

}  // namespace contactscope
