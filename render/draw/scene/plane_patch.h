#pragma once

#include <vector>

#include "draw/scene/scene.h"

/// What is drawn of a half-space: a rectangle of its plane, cut out around the shapes.
namespace contactscope::draw {

/// Gives every plane of `meshes` its patch: under the finite shapes of all frames and a margin
/// around them, with level edges. Without finite shapes a square of two metres.
void fit_patches(const trace::Header& header, const std::vector<trace::Frame>& frames,
                 std::vector<ShapeMesh>& meshes);

/// World; `plane` has a patch.
std::vector<Vec3d> patch_corners(const PlacedShape& plane);

/// The rectangle, its border, and ticks that hang into the solid from the borders that face the
/// viewer: the sign for solid ground. Seen from inside of the solid, only the border.
void draw_plane(const Scene& scene, const PlacedShape& shape, Sketch& sketch);

}  // namespace contactscope::draw
