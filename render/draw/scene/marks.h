#pragma once

#include <string>

#include "draw/scene/pen.h"
#include "draw/scene/sketch.h"

namespace contactscope::draw {

/// A mark of a sketch, at its place on the screen. Returns the radius that labels keep off, pixels of
/// the canvas; 0: they may cover it.
float draw_mark(MarkKind kind, const Point2& at, const Color& color, const Pen& pen);

/// A ring filled on its left, pixels.
void draw_half_dot(const Point2& center, float radius, float border, const Color& color,
                   Drawing& drawing);

/// A disc quartered black and white, as drawings mark a centre of mass, with a white halo; pixels.
void draw_quartered_disc(const Point2& center, float radius, float border, Drawing& drawing);

/// A filled square with a white halo; `half`: of its width, pixels.
void draw_square(const Point2& center, float half, const Color& color, Drawing& drawing);

/// What became of a point of an incremental manifold in a frame.
enum class PointState { New, Persisted, Broken };
/// As a trace spells it.
PointState point_state(const std::string& state);

/// How such a point looks: new ones filled, persisted ones half-filled, broken ones hollow.
void draw_state_dot(PointState state, const Point2& center, float radius, const Color& color,
                    Drawing& drawing);

}  // namespace contactscope::draw
