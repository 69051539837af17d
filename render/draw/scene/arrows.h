#pragma once

#include "draw/scene/scene.h"

/// Lengths as drawings measure them, and turns.
namespace contactscope::draw {

/// A length between two points, which `text` explains: a two-headed arrow, or where that would be too
/// short to be one, two that point at it from outside.
void draw_measure(const Scene& scene, const Vec3d& from, const Vec3d& to, float width,
                  const std::string& text, Sketch& sketch);

/// A gap of `metres` between two points, with its length `clearance` pixels away along `aside`.
void draw_gap(const Scene& scene, const Vec3d& from, const Vec3d& to, double metres,
              double clearance, const Vec3d& aside, Sketch& sketch);

/// Adds an arc of a circle about `axis` (unit) through `center` that ends in a head: a turn by
/// `angle` radians > 0, counter-clockwise against the axis. Its middle is nearest to the eye.
void draw_curved_arrow(const Camera& camera, const Vec3d& center, const Vec3d& axis, double radius,
                       double angle, float width, const Color& color, Sketch& sketch);

}  // namespace contactscope::draw
