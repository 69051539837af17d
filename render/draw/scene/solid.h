#pragma once

#include "draw/scene/scene.h"

/// Shapes that are no surface of triangles, and no plane.
namespace contactscope::draw {

/// The faces that show their outside, or where `both_sides` all. Tells of each whether it shows its
/// outside.
std::vector<bool> draw_faces(const Camera& camera, const PlacedShape& shape, const Color& fill,
                             bool both_sides, Sketch& sketch);

/// Faces, silhouette and edges of a polyhedron: hidden lines are faint.
void draw_solid(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch);

/// A smooth outline, and inside the core that all is measured from: Gregorius 2015 draws spheres and
/// capsules as points and segments with a radius.
void draw_round(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch);

/// Whether some of the shape is in the picture. Planes and meshes count as such.
bool in_view(const Camera& camera, const PlacedShape& shape);

}  // namespace contactscope::draw
