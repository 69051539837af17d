#pragma once

#include "core/plane.h"

namespace contactscope {

/// Everything below a plane: the points x with normal . x <= offset, own frame. Scenarios call it
/// "plane", as engines do.
template <class S>
struct HalfSpace {
  Plane<S> plane;
};

}  // namespace contactscope
