#pragma once

#include "draw/staging.h"

namespace contactscope::vector {

/// Positions of contact points, normals, faces, shapes, labels and rectangles in a picture, as
/// JSON: in pixels and as fractions of its size. README.md of this folder lists the keys. Omits
/// objects behind the eye or outside the view. `drawing` is that of the frame, with panels.
std::string anchors_of(const draw::Staging& staging, const trace::Frame& frame,
                       const draw::Drawing& drawing);

}  // namespace contactscope::vector
