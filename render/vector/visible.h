#pragma once

#include <vector>

#include "draw/scene/drawing.h"

namespace contactscope::vector {

/// For each primitive, true if it is visible: it has a colour and a size, reaches into the canvas,
/// and later opaque fills do not cover all its pixels and their neighbours.
///
/// Goes from the last primitive to the first. A fill without alpha covers the pixels with their
/// centres inside, as in rasterization. A primitive that touches only covered pixels is hidden.
std::vector<bool> visible(const draw::Drawing& drawing);

}  // namespace contactscope::vector
