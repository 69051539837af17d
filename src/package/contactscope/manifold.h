#pragma once

#include <string>
#include <vector>

#include "namespace.h"

namespace contactscope::package {

/// A position in metres, or a direction.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// A rotation, scalar part first.
struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;

  friend bool operator==(const Quaternion&, const Quaternion&) = default;
};

/// x_world = rotation * x_local + position. Functions that take a pose normalize its quaternion.
struct Pose {
  Vec3 position{};  // metres
  Quaternion rotation{};
};

/// Precision of the pipeline. Results are returned in double, without loss.
enum class Scalar { Float, Double };

struct ContactPoint {
  Vec3 position{};        // world, metres
  double separation = 0;  // metres along the normal; negative = overlap
  /// The two features that made the point, "a:e3 b:e7", as in traces. Empty if unknown.
  std::string id{};
};

/// Contact points that share a normal.
struct Manifold {
  Vec3 normal{};  // world, unit, from a to b
  std::vector<ContactPoint> points{};
  std::string axis{};  // "face_a", "face_b", "edge_edge", "closest_points"; empty: not recorded
  std::string type{};  // features in contact: "point-face", ...; empty: not recorded
  int triangle = -1;   // index in the mesh; -1: of a whole pair
};

/// Separation of the deepest point in metres, negative = overlap; 0 without points.
double separation_of(const Manifold& manifold);

/// "normal (0, 1, 0), 2 points: (0.5, 0, 0.5) -0.02, (-0.5, 0, 0.5) -0.02", with six digits.
std::string to_string(const Manifold& manifold);

}  // namespace contactscope::package
