#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/pose.h"
#include "trace/trace.h"

/// Two shapes in one frame, as numbers of a scenario, for the shrinker.
namespace contactscope::shrink {

/// Rotation of a shape: a quaternion as found, or axis and degrees, which can be rounded freely.
struct Turn {
  enum class Form { None, Quaternion, AxisDegrees } form = Form::None;
  std::array<double, 4> numbers{};  // w, x, y, z; or the axis, of any length, and degrees
};

struct SmallShape {
  enum class Kind { Box, Hull, Sphere, Capsule, Plane, Mesh } kind = Kind::Hull;
  std::string name;
  std::vector<Vec3d> vertices;  // for hulls, meshes and capsules (two ends), own frame
  std::vector<std::array<int, 3>> triangles{};  // for meshes
  Vec3d half_extents = Vec3d::Zero();           // for boxes
  double radius = 0;                            // for spheres and capsules
  Vec3d normal = Vec3d::UnitY();                // for planes
  double offset = 0;
  Vec3d position = Vec3d::Zero();
  Turn turn{};

  Pose<double> pose() const;
  int vertex_count() const;  // 8 for a box, 1 for a sphere, 2 for a capsule, 0 for a plane
};

/// A key of [pipeline] with a value other than the default: "scalar", "\"double\"".
using Setting = std::pair<std::string, std::string>;

struct PairOfTwo {
  std::string up = "y";
  SmallShape a, b;
  std::vector<Setting> settings;
  std::vector<Setting> expectation{};  // keys of [[expect]] other than a and b; none: no entry
  /// Claims of another engine, in the frame of a; empty if the pipeline's own result is tested.
  std::optional<std::vector<trace::Manifold>> claims{};

  int vertex_count() const { return a.vertex_count() + b.vertex_count(); }
};

/// The shortest text that round-trips to this number; "3" for 3.
std::string spell(double number);
std::string spell(const Vec3d& vector);
std::string quoted(const std::string& text);

/// All numbers of the two, in a fixed order.
std::vector<double*> numbers_of(PairOfTwo& pair);

/// Digits of all numbers, to be minimised; 0 has none.
int digits_of(const PairOfTwo& pair);

/// The scenario. `title` and `source` are as displayed.
std::string to_scenario(const PairOfTwo& pair, const std::string& title, const std::string& source);

}  // namespace contactscope::shrink
