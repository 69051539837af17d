#pragma once

#include <cmath>
#include <limits>
#include <random>

#include "geometry/aabb.h"

namespace contactscope::testing {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Distribution of the boxes of a scene.
enum class Spread {
  Uniform,    // of similar size
  Clustered,  // sizes over three decades, about a few places
  Lattice,    // unit cubes on integer coordinates: neighbours touch, many coincide
};

class RandomBoxes {
 public:
  /// `side`: of the cube that contains the boxes' centres, metres.
  RandomBoxes(Spread spread, float side, std::uint32_t seed)
      : spread_(spread), side_(side), engine_(seed) {}

  float between(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(engine_);
  }
  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }
  Vec3<float> vector(float low, float high) {
    const float x = between(low, high), y = between(low, high);
    return {x, y, between(low, high)};
  }

  Aabb<float> box() {
    Vec3<float> center = vector(0, side_), half = vector(0.25f, 0.5f);
    if (spread_ == Spread::Clustered) {
      half *= std::pow(10.0f, between(-2, 1));
      center = Vec3<float>::Constant(0.2f * side_ * static_cast<float>(below(5))) +
               vector(-1, 1).cwiseProduct(vector(0, 0.1f * side_));
    } else if (spread_ == Spread::Lattice) {
      center = center.array().floor();
      half.setConstant(0.5f);
    }
    return {center - half, center + half};
  }

  /// Occasionally one of the kinds that break broad phases.
  Aabb<float> odd_box(const Aabb<float>& other) {
    switch (below(40)) {
      case 0:
        return {Vec3<float>::Constant(-kInfinity), Vec3<float>::Constant(kInfinity)};
      case 1:
        return {Vec3<float>::Constant(-kInfinity), {kInfinity, 0.5f * side_, kInfinity}};
      case 2:
        return other;  // the same place
      case 3:
        return {other.lower, other.lower};  // a point
      case 4:
        return {1e6f * other.lower, 1e6f * other.upper};
      case 5:
        return {other.lower, other.lower.cwiseMax(Vec3<float>::Constant(3e38f))};
      default:
        return box();
    }
  }

 private:
  Spread spread_;
  float side_;
  std::mt19937 engine_;
};

}  // namespace contactscope::testing
