#pragma once

#include <array>

#include "core/vec3.h"

namespace contactscope {

/// All points within `radius` of a segment. The segment may have length zero: then it is a ball.
template <class S>
struct Capsule {
  std::array<Vec3<S>, 2> points;  // ends of the segment, own frame, metres
  S radius = 0;                   // metres, > 0
};

}  // namespace contactscope
