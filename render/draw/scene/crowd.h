#pragma once

#include "draw/scene/scene.h"

namespace contactscope::draw {

/// Contact points among many shapes, instead of dots with whiskers. In a heap their area is in
/// proportion to the overlap, and one stands out: the point of the pair that the view focuses on,
/// otherwise the deepest one, with its normal, its bodies' outlines, their names and the overlap.
/// Next to the panel `worst` its other pairs have their numbers.
void draw_crowd(const Scene& scene, Sketch& sketch);

/// The pair that stands out in a frame; nullptr if none overlaps.
const trace::Pair* marked_pair(const Scene& scene);

}  // namespace contactscope::draw
