#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/pose.h"
#include "trace/trace.h"

/// Two shapes in one frame, in the numbers of which a scenario is written: what a shrinker makes smaller.
namespace contactscope::shrink {

/// How a shape is turned: as it was found, or by an axis and degrees, whose numbers can be rounded freely.
struct Turn {
  enum class Form { None, Quaternion, AxisDegrees } form = Form::None;
  std::array<double, 4> numbers{};  // w, x, y, z; or the axis, of any length, and degrees
};

struct SmallShape {
  enum class Kind { Box, Hull, Sphere, Capsule, Plane, Mesh } kind = Kind::Hull;
  std::string name;
  std::vector<Vec3d> vertices;  // of hulls, meshes and capsules (two ends), own frame
  std::vector<std::array<int, 3>> triangles{};  // of meshes
  Vec3d half_extents = Vec3d::Zero();           // of boxes
  double radius = 0;                            // of spheres and capsules
  Vec3d normal = Vec3d::UnitY();                // of planes
  double offset = 0;
  Vec3d position = Vec3d::Zero();
  Turn turn{};

  Pose<double> pose() const;
  int vertex_count() const;  // 8 of a box, 1 of a sphere, 2 of a capsule, none of a plane
};

/// A key of [pipeline] that is not as it is by itself: "scalar", "\"double\"".
using Setting = std::pair<std::string, std::string>;

struct PairOfTwo {
  std::string up = "y";
  SmallShape a, b;
  std::vector<Setting> settings;
  std::vector<Setting> expectation{};  // keys of [[expect]] beside a and b; none: no entry
  /// What another engine claims, in the frame of a; empty where the pipeline's own answer is what counts.
  std::optional<std::vector<trace::Manifold>> claims{};

  int vertex_count() const { return a.vertex_count() + b.vertex_count(); }
};

/// The shortest text that reads back as this number; "3" of 3.
std::string spell(double number);
std::string spell(const Vec3d& vector);
std::string quoted(const std::string& text);

/// Every number of the two, in a fixed order.
std::vector<double*> numbers_of(PairOfTwo& pair);

/// Digits of all numbers, what roundness is measured by: 0 has none.
int digits_of(const PairOfTwo& pair);

/// The scenario. `title` and `source` are as a reader sees them.
std::string to_scenario(const PairOfTwo& pair, const std::string& title, const std::string& source);

}  // namespace contactscope::shrink
