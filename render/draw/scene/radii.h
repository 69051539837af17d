#pragma once

#include "draw/scene/scene.h"

namespace contactscope::draw {

/// Of a pair one of which is round: what its contact is measured from. A sphere is its centre with a
/// radius, a capsule a segment with one: marked are the points of these cores that are nearest to each
/// other, the ball about a capsule's (dashed: the virtual sphere), and at the first point the two radii,
/// the distance of the cores, and the sum that the overlap or the gap is. Meshes and planes have none.
void draw_radii(const Scene& scene, const trace::Pair& pair, Sketch& sketch);

}  // namespace contactscope::draw
