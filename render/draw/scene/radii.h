#pragma once

#include "draw/scene/scene.h"

namespace contactscope::draw {

/// Measures the contact of a pair with a round shape. A sphere is a centre with a radius, a capsule
/// a segment with a radius. Marked are the nearest points of these cores and the ball about a
/// capsule's point (dashed: the virtual sphere). At the first point also the two radii, the
/// distance of the cores, and the sum that gives the overlap or gap. Meshes and planes have none.
void draw_radii(const Scene& scene, const trace::Pair& pair, Sketch& sketch);

}  // namespace contactscope::draw
