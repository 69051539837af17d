#pragma once

#include "draw/scene/scene.h"

/// Triangle meshes, of a step in a staircase or of ten thousand triangles.
namespace contactscope::draw {

/// Surfaces of the triangles, strong lines where the surface ends, bends or turns away from the
/// eye, thin ones between triangles, which fade as these become small on the screen. Both sides of
/// an open mesh are drawn, for both collide.
void draw_mesh(const Scene& scene, const PlacedShape& shape, Sketch& sketch);

/// Highlights the triangles that have a manifold with any shape, each once: as a reference face, or
/// as an incident face where the reference is a face of the other shape.
void draw_touched_triangles(const Scene& scene, Sketch& sketch);

}  // namespace contactscope::draw
