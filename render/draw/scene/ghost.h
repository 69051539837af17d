#pragma once

#include "draw/scene/scene.h"

/// A shape where it is not now: a little later, or never.
namespace contactscope::draw {

/// The shape turned about `pivot` by `turn` (axis times radians) and then moved by `way`, metres; all
/// in the world.
PlacedShape moved(PlacedShape shape, const Vec3d& pivot, const Vec3d& way, const Vec3d& turn);

/// The silhouette alone.
void draw_ghost(const Camera& camera, const PlacedShape& shape, const LineStyle& style,
                Sketch& sketch);

}  // namespace contactscope::draw
