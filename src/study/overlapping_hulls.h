#pragma once

#include <random>
#include <vector>

#include "core/pose.h"
#include "geometry/hull.h"

namespace contactscope {

struct OverlappingHulls {
  Hull<double> a, b;
  Pose<double> b_in_a;
  double size = 1;             // metres: the longest semi-axis of both
  double separation = 0;       // metres, < 0: the oracle's (depth_oracle.h)
  Vec3d way = Vec3d::UnitX();  // unit, A's frame: from where B came, for methods that look back
  Vec3d turn_axis = Vec3d::UnitX();  // unit, A's frame: about which it turned
};

/// Two hulls of `vertices` points each on ellipsoids with semi-axes of 0.5 to 1 times a size of 1
/// mm to 1 km (log-uniform), turned at random, moved along a random direction until they overlap by
/// 1 to 10% of the size along it; drawn again where another axis separates them.
OverlappingHulls overlapping_hulls(std::mt19937_64& engine, int vertices);

}  // namespace contactscope
