#pragma once

#include <cstdint>
#include <random>

#include "core/pose.h"
#include "geometry/hull.h"

namespace contactscope::test {

/// Random numbers that are the same with every standard library and compiler: the engine is
/// specified to the bit, the standard distributions are not. A compiler may evaluate arguments and
/// operands in any order, so put two draws into two statements, or into braces.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// In [low, high).
  double uniform(double low, double high);
  /// 10 to a uniform power: every decade is equally likely.
  double decade(double low_exponent, double high_exponent);
  /// In [0, count).
  int index(int count);
  bool chance(double probability) { return uniform(0, 1) < probability; }
  /// Three coordinates in [low, high).
  Vec3d vector(double low, double high);
  /// x and z in [-reach, reach), y as given.
  Vec3d level(double reach, double y);
  Vec3d unit_vector();
  Quatd rotation();
  /// A rotation by an angle in radians about a random axis.
  Quatd rotation_by(double angle);
  /// Any rotation; the position is within `radius` metres of the origin.
  Pose<double> pose(double radius);

 private:
  std::mt19937_64 engine_;
};

/// Each half extent is independently 1 to `aspect` times shorter than `size` metres.
Hull<double> random_box(Random& random, double size, double aspect);

/// Hull of `vertices` points on an ellipsoid of at most `size` metres, turned at random. Its axes
/// are up to `aspect` times shorter. All faces are triangles, all points are vertices.
Hull<double> random_hull(Random& random, int vertices, double size, double aspect);

}  // namespace contactscope::test
