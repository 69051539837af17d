#pragma once

#include <string>

#include "draw/scene/drawing.h"
#include "draw/staging.h"
#include "trace/trace.h"

namespace contactscope::vector {

/// Where the things of a picture are in it, as JSON: contact points, normals, faces, shapes, labels and
/// rectangles, in pixels and as fractions of width and height. README.md of this folder lists the keys.
/// What is behind the eye or outside of the view is left out. `drawing` is of this frame, with its
/// panels.
std::string anchors_of(const draw::Staging& staging, const trace::Frame& frame,
                       const draw::Drawing& drawing);

}  // namespace contactscope::vector
