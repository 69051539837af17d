#pragma once

#include <random>

#include "core/vec3.h"

namespace contactscope {

/// Uniform in [low, high), the same everywhere: the standard specifies engines, not distributions.
inline double uniform(std::mt19937_64& engine, double low, double high) {
  return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
}

/// A unit vector, uniform on the sphere.
inline Vec3d random_direction(std::mt19937_64& engine) {
  const double z = uniform(engine, -1, 1);
  const double turn = uniform(engine, 0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

}  // namespace contactscope
