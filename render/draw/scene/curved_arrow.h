#pragma once

#include "draw/scene/sketch.h"

namespace contactscope::draw {

/// Adds an arc of a circle about `axis` (unit) through `center` that ends in a head: a turn by
/// `angle` radians > 0, counter-clockwise against the axis. Its middle is nearest to the eye.
void draw_curved_arrow(const Camera& camera, const Vec3d& center, const Vec3d& axis, double radius,
                       double angle, float width, const Color& color, Sketch& sketch);

}  // namespace contactscope::draw
