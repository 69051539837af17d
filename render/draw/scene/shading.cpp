#include "draw/scene/shading.h"

namespace contactscope::draw {

Vec3d key_light(const Camera& camera) {
  return (camera.up() * 1.0 - camera.right() * 0.55 + camera.right().cross(camera.up()) * 0.65)
      .normalized();
}

Color toned(const Color& base, double lit) {
  // What looks at the light, what lies between, what is turned from it.
  constexpr float kTones[3] = {1.0f, 0.93f, 0.84f};
  const float tone = kTones[lit > kToneBorders[0] ? 0 : lit > kToneBorders[1] ? 1 : 2];
  return {base.r * tone, base.g * tone, base.b * tone, kShapeAlpha};
}

}  // namespace contactscope::draw
