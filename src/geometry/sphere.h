#pragma once

namespace contactscope {

/// Ball about the origin of its own frame.
template <class S>
struct Sphere {
  S radius = 0;  // metres, > 0
};

}  // namespace contactscope
