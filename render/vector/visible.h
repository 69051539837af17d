#pragma once

#include <vector>

#include "draw/scene/drawing.h"

namespace contactscope::vector {

/// For each primitive whether any of it is seen: it has a colour and a size, it reaches into the
/// canvas, and opaque fills painted later do not cover all of the pixels that it touches and those
/// around them.
///
/// Steps: from the last primitive to the first; a fill without alpha covers the pixels whose middle it
/// holds, as it does when it is rasterized; who touches covered pixels alone is hidden.
std::vector<bool> visible(const draw::Drawing& drawing);

}  // namespace contactscope::vector
