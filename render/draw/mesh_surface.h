#pragma once

#include "draw/scene.h"

/// Triangle meshes, of a step in a staircase or of ten thousand triangles.
namespace contactscope::draw {

/// Surfaces of the triangles, strong lines where the surface ends, bends or turns away from the
/// eye, thin ones between triangles, which fade as these become small on the screen. Both sides of
/// an open mesh are drawn, for both collide.
void draw_mesh(const Scene& scene, const PlacedShape& shape, Sketch& sketch);

/// Highlights the triangles that have a manifold: as reference faces, or as incident faces where a
/// face of the other shape is the reference.
void draw_touched_triangles(const Scene& scene, const trace::Pair& pair, Sketch& sketch);

}  // namespace contactscope::draw
