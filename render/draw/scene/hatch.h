#pragma once

#include <vector>

#include "core/convex_polygon.h"
#include "draw/scene/drawing.h"

namespace contactscope::draw {

/// Rising lines over what of convex polygon `whole` lies outside convex polygon `hole`. Pixels;
/// both in the winding of convex_polygon. A hole of fewer than three corners is none.
void hatch(const std::vector<Vec2d>& whole, const std::vector<Vec2d>& hole, double spacing,
           float width, const Color& color, Drawing& drawing);

}  // namespace contactscope::draw
