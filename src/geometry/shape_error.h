#pragma once

#include <stdexcept>

namespace contactscope {

/// A hull or a mesh cannot be made from what was given: what() says why, and what would be right.
/// Geometry knows no file; whoever reads one catches this and adds the place.
struct ShapeError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace contactscope
