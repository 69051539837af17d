#pragma once

#include <array>

#include "draw/scene/camera.h"
#include "draw/scene/drawing.h"

/// A flat key light from the upper left of the camera, in three tones.
namespace contactscope::draw {

/// Light enough for the contact inside to be seen, dense enough for a shape to read as solid.
inline constexpr float kShapeAlpha = 0.52f;
/// Cosines to the light at which one tone gives way to the next, brightest first.
inline constexpr std::array<double, 2> kToneBorders = {0.6, 0.1};

/// Towards the light, unit.
Vec3d key_light(const Camera& camera);

/// The colour of a shape's surface whose normal has this cosine to the light.
Color toned(const Color& base, double lit);

}  // namespace contactscope::draw
