#pragma once

#include <string>
#include <vector>

#include "namespace.h"

namespace contactscope::package {

/// A place, metres, or a direction.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// A rotation, w first.
struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;

  friend bool operator==(const Quaternion&, const Quaternion&) = default;
};

/// Where a shape is: x_world = rotation * x_local + position. What takes one makes the quaternion unit.
struct Pose {
  Vec3 position{};  // metres
  Quaternion rotation{};
};

/// What a pipeline computes with. Results are told in double, and are those of the pipeline exactly.
enum class Scalar { Float, Double };

struct ContactPoint {
  Vec3 position{};        // world, metres
  double separation = 0;  // metres along the normal; negative = overlap
  /// "a:e3 b:e7": the two features that made it, as traces spell it. Empty where nobody knows.
  std::string id{};
};

/// Contact points that share a normal.
struct Manifold {
  Vec3 normal{};  // world, unit, from a to b
  std::vector<ContactPoint> points{};
  std::string axis{};  // "face_a", "face_b", "edge_edge", "closest_points"; empty: not told
  std::string type{};  // "point-face", ...: which features touch; empty: not told
  int triangle = -1;   // of a mesh, that the manifold belongs to; -1: neither shape is a mesh
};

/// Metres of the deepest point, negative in overlap; 0 without points.
double separation_of(const Manifold& manifold);

/// "normal (0, 1, 0), 2 points: (0.5, 0, 0.5) -0.02, (-0.5, 0, 0.5) -0.02", with six digits.
std::string to_string(const Manifold& manifold);

}  // namespace contactscope::package
