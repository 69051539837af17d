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
inline Vec3d key_light(const Camera& camera) {
  return (camera.up() * 1.0 - camera.right() * 0.55 + camera.right().cross(camera.up()) * 0.65)
      .normalized();
}

/// The colour of a shape's surface whose normal has this cosine to the light.
inline Color toned(const Color& base, double lit) {
  const float tone = lit > kToneBorders[0] ? 1.0f : lit > kToneBorders[1] ? 0.93f : 0.84f;
  return {base.r * tone, base.g * tone, base.b * tone, kShapeAlpha};
}

}  // namespace contactscope::draw
