#pragma once

#include "draw/scene/scene.h"

/// A shape where it is not now: a little later, or never.
namespace contactscope::draw {

/// The shape turned about `pivot` by `turn` (axis times radians) and then moved by `way`, metres; all
/// in the world.
PlacedShape moved(PlacedShape shape, const Vec3d& pivot, const Vec3d& way, const Vec3d& turn);

/// The silhouette; of a shape with faces also these where there is a `fill`.
void draw_ghost(const Camera& camera, const PlacedShape& shape, const LineStyle& style,
                Sketch& sketch, const std::optional<Color>& fill = std::nullopt);

}  // namespace contactscope::draw
