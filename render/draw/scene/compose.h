#pragma once

#include "draw/scene/camera.h"
#include "draw/scene/drawing.h"
#include "draw/scene/layout.h"
#include "draw/scene/sketch.h"

namespace contactscope::draw {

/// Resolves a sketch into pixels: surfaces in depth order, lines split into seen and hidden parts,
/// arrows, marks, and labels where they find place. Adds to `drawing`.
void compose(const Sketch& sketch, const Camera& camera, const Layout& layout, Drawing& drawing);

}  // namespace contactscope::draw
