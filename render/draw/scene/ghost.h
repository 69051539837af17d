#pragma once

#include "draw/scene/scene.h"

/// Shapes drawn at poses that they do not have in this frame, such as predicted or corrected ones.
namespace contactscope::draw {

/// Turns the shape about `pivot` by `turn` (axis times radians), then moves it by `offset`. World,
/// metres.
PlacedShape moved(PlacedShape shape, const Vec3d& pivot, const Vec3d& offset, const Vec3d& turn);

/// Draws the silhouette; with a `fill` also the faces of a shape that has faces.
void draw_ghost(const Camera& camera, const PlacedShape& shape, const LineStyle& style,
                Sketch& sketch, const std::optional<Color>& fill = std::nullopt);

/// Draws a displacement, with an arrow head if it is long enough. It ends `before` metres before
/// `to`.
void draw_path(const Scene& scene, const Vec3d& from, const Vec3d& to, double before,
               const LineStyle& style, Sketch& sketch);

/// Radius of a ball, at which a displacement line to its centre ends; 0 for other shapes, metres.
double border_of_ball(const PlacedShape& shape);

}  // namespace contactscope::draw
