#pragma once

#include <string>

#include "draw/scene/drawing.h"

namespace contactscope::draw {

/// A ring filled on its left, pixels.
void draw_half_dot(const Point2& center, float radius, float border, const Color& color,
                   Drawing& drawing);

/// A disc quartered black and white, as drawings mark a centre of mass, with a white halo; pixels.
void draw_quartered_disc(const Point2& center, float radius, float border, Drawing& drawing);

/// A filled square with a white halo; `half`: of its width, pixels.
void draw_square(const Point2& center, float half, const Color& color, Drawing& drawing);

/// How an incremental manifold's point looks: "new" filled, "persisted" half-filled, "broken"
/// hollow.
void draw_state_dot(const std::string& state, const Point2& center, float radius,
                    const Color& color, Drawing& drawing);

}  // namespace contactscope::draw
