#pragma once

#include "find/expression.h"
#include "scenario/scenario.h"
#include "trace/json.h"

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

/// An engine to query for contacts: returns its trace.
using Engine = std::function<trace::Trace(const trace::Trace& request)>;

/// The names that a condition of `shrink` may use.
const find::Vocabulary& vocabulary();

/// Tests whether a pair still has the property, by the scenario that would be written for it.
class Judge {
 public:
  /// `engines`: one for each side of the expression that is not built in: "", "float", "double",
  /// "recorded", "lint", "unmet".
  explicit Judge(const find::Expression& expression, std::map<std::string, Engine> engines = {})
      : expression_(expression), engines_(std::move(engines)) {}

  /// Also false for invalid scenarios: a hull without volume, a shape that is too large.
  bool holds(const PairOfTwo& pair);
  /// From now on `unmet` means the unmet expectations of this pair and no others: a pair with two
  /// instead of four points must not become one with none.
  void remember_unmet(const PairOfTwo& pair);
  int requested() const { return queries_; }

  /// Result of the pipeline in double, the default expectation. Empty if the scenario is invalid.
  static std::optional<trace::Pair> in_double(const PairOfTwo& pair);
  /// The pair as a trace of one frame, with its claims if it has any.
  static trace::Trace trace_of(const PairOfTwo& pair);

 private:
  const find::Expression& expression_;
  std::map<std::string, Engine> engines_;
  std::unordered_map<std::string, bool> known_;
  std::optional<std::vector<std::string>> unmet_;
  std::optional<std::size_t> warnings_;  // of the first pair with the property
  int queries_ = 0;
};

struct Shrunk {
  PairOfTwo pair;
  int tried = 0;  // number of pairs tested
};

/// Finds a minimal pair that keeps the property tested by the judge. Zeller and Hildebrandt 2002,
/// "Simplifying and Isolating Failure-Inducing Input", ddmin: remove parts, first halves and then
/// smaller ones, while the property holds. Steps, repeated until a round changes nothing:
///
/// 1. vertices of hulls, triangles of meshes, claimed points; boxes become hulls if that has fewer;
/// 2. keys of the pipeline;
/// 3. poses: a at the origin without rotation, b without rotation;
/// 4. numbers: to one digit, two, ... all at once, then individually.
///
/// Terminates because every accepted step has fewer vertices, or as many and fewer claims, keys or
/// digits. Deterministic: no randomness. `progress` is called after each accepted step.
Shrunk shrink(const PairOfTwo& start, Judge& judge,
              const std::function<void(const PairOfTwo&)>& progress = {});

/// A single pair of a frame: its shapes in the poses of the frame. `scenario`: source of the pair's
/// settings and expectations; null for a trace of another engine, whose claims are kept. Empty if
/// it cannot be written as a scenario of two shapes: a distance field, an unknown shape.
std::optional<PairOfTwo> pair_of_frame(const trace::Header& header, const trace::Frame& frame,
                                       const trace::Pair& pair, const Scenario* scenario);

}  // namespace contactscope::shrink
