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

/// How it gets there: a line from one place to another, with a head at its end where it is long
/// enough for one. It ends `before` metres before the other place.
void draw_way(const Scene& scene, const Vec3d& from, const Vec3d& to, double before,
              const LineStyle& style, Sketch& sketch);

/// Metres from the middle of a ball to its border, at which a way to it ends; 0 of others.
double border_of_ball(const PlacedShape& shape);

}  // namespace contactscope::draw
