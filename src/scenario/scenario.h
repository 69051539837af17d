#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "continuous/impact_of_shapes.h"
#include "core/at.h"
#include "core/manifold.h"
#include "core/pose.h"
#include "core/view.h"
#include "dynamics/solver_settings.h"
#include "geometry/shape.h"
#include "manifold/collide_options.h"
#include "manifold/pair_query.h"
#include "reduce/reducer.h"
#include "scenario/deform.h"

/// What a scenario file holds, read and checked; scenarios/README.md is the reference of the format.
namespace contactscope {

/// Position and rotation at a time; what a keyframe leaves out is taken from the keyframe before
/// it, the first from the shape's own pose.
struct Keyframe {
  double time = 0;  // seconds
  Pose<double> pose;
};

/// Scripted motion: keyframes (positions linear, rotations slerp, ends held), or constant
/// velocities from the shape's own pose. Velocities in world space, m/s and rad/s about the shape's
/// origin.
struct Motion {
  std::vector<Keyframe> keyframes;
  Vec3d velocity = Vec3d::Zero();
  Vec3d angular_velocity = Vec3d::Zero();
  std::shared_ptr<const Deformation> deformation{};  // null: it keeps its form
};

/// Of a shape that the solver moves. Its mass is spread evenly through its volume.
struct ScenarioBody {
  double mass = 1;                         // kilograms
  Vec3d velocity = Vec3d::Zero();          // metres a second, of the centre of mass, at the start
  Vec3d angular_velocity = Vec3d::Zero();  // radians a second, world, at the start
};

struct ScenarioShape {
  std::string name;
  std::string type;  // "box", "hull", "cylinder", "cone", "sphere", "capsule", "plane", "mesh"
  std::shared_ptr<const Shape<double>> geometry;  // as the file has it
  Pose<double> pose;
  Motion motion;
  std::optional<ScenarioBody> body{};  // empty: it moves as `motion` says
  // Of a contact the friction is the geometric mean of both shapes', the restitution the larger.
  std::optional<double> friction{};     // default: the world's
  std::optional<double> restitution{};  // default: the world's

  /// What is rounded and collided: `geometry`, or where that is far from its own origin the same
  /// about its middle (see shape.h), which is at `collider_origin` in the file's frame, metres.
  /// Traces tell shapes and poses as the file has them.
  std::shared_ptr<const Shape<double>> collider{};
  Vec3d collider_origin = Vec3d::Zero();
  TreeUpdate tree = TreeUpdate::Auto;  // of a mesh that deforms

  /// The solver moves it.
  bool dynamic() const { return body.has_value(); }
  bool deforms() const { return motion.deformation != nullptr; }
  bool is_moved() const { return !collider_origin.isZero(0); }
  bool is_mesh() const { return kind_of(*geometry) == ShapeKind::Mesh; }
  /// nullptr for shapes that are no hulls.
  const Hull<double>* hull() const { return std::get_if<Hull<double>>(geometry.get()); }
};

enum class Scalar { Float, Double };

/// Gregorius 2015, "Incremental vs One-Shot Manifold".
enum class ManifoldKind { OneShot, Incremental };

/// Where the traversal of the trees of two meshes begins.
enum class Traversal {
  FromRoots,
  Coherent,  // where that of the frame before ended
};

struct PipelineSettings {
  Scalar scalar = Scalar::Float;
  std::string reducer = kDefaultReducer;
  int max_points = 4;
  double margin = 0;  // metres
  bool cache = true;
  Preference preference = Preference::Relative;
  Degenerate degenerate = Degenerate::Fallback;
  FieldSearch field = FieldSearch::Conservative;
  bool internal_edges = true;
  PenetrationMethod penetration = PenetrationMethod::Sat;
  ManifoldKind manifold = ManifoldKind::OneShot;
  IncrementalSettings incremental;
  /// What is done about what meets in the step after each frame; none, "discrete": nothing.
  std::optional<ImpactMethod> continuous{};
  Traversal traversal = Traversal::FromRoots;  // of two meshes that are asked
  Question question;  // by default the manifold; its penetration method is `penetration`

  /// The solver and reducers get the pair's contacts.
  bool makes_contacts() const { return question.kind == QueryKind::Manifold; }

  friend bool operator==(const PipelineSettings&, const PipelineSettings&) = default;
};

/// Why nobody can say by this method when two shapes meet between frames; nothing where one can.
std::optional<std::string> impact_refusal(const ScenarioShape& a, const ScenarioShape& b,
                                          ImpactMethod method);

/// Two shapes to collide, by index into Scenario::shapes, with the settings for this pair: those of
/// [pipeline], overridden by the keys of the [[pairs]] entry.
struct ScenarioPair {
  int a = 0;
  int b = 0;
  std::string label;  // tells apart entries that name the same two shapes
  PipelineSettings pipeline;
};

/// Contact points that were found elsewhere, as a [[patch]] has them: there are no shapes to collide,
/// and nothing but their reduction to run.
struct ScenarioPatch {
  std::string name;
  Vec3d normal = Vec3d::UnitY();               // unit, from a to b
  std::vector<ContactPoint<double>> points{};  // world; at least one
};

/// One [[expect]] entry: what `check` asks of a pair over a range of frames.
struct Expectation {
  int first_frame = 0;
  int last_frame = 0;  // inclusive
  int a = 0;
  int b = 0;
  std::string label;
  std::optional<std::string> state;  // "touching", "separated"
  std::optional<bool> overlap;       // of a pair that is asked something
  std::optional<bool> touching;      // of one that is asked for "touching"
  std::optional<int> intersections;  // of two meshes: pairs of triangles that share a point
  std::optional<int> points;
  std::optional<std::string> axis;  // "face_a", "face_b", "edge_edge", "closest_points"
  std::optional<std::string> type;  // "point-face", ...
  std::optional<Vec3d> normal;
  std::optional<double> separation;   // metres, deepest point
  std::optional<double> load;         // newtons, what the solver's normal impulses come to
  std::optional<std::string> impact;  // "hit", ...: in the step after the frame
  std::optional<double> impact_time;  // fraction of that step
  std::optional<int> ghosts;          // speculative points that hold back what would not meet
  std::optional<int> stops;           // of the two, by the solver, in that step
  std::optional<bool> asleep;         // the bodies of the pair, through that step
  double tolerance = 1e-5;  // metres, and for each component of the normal; share of the load
  int line = 0;             // in the file, for messages
};

/// What a picture may differ by from the stored one; where nothing is said, render/image/compare.h has it.
struct PictureLimits {
  std::optional<int> channel, cluster, total;
};

/// Which frames `check` stores, in what size, and how exactly they are compared.
struct SnapshotSettings {
  std::vector<int> frames;  // default: first, middle, last
  int width = 640;
  int height = 360;
  PictureLimits limits{};
  std::map<std::string, PictureLimits> view_limits{};  // by the view's name
};

struct Scenario {
  std::string name;  // "<group>/<idea>", from the path
  std::string path;
  std::string title;
  std::string source;
  std::vector<std::string> tags;
  std::string up = "y";
  int frames = 1;
  double dt = 1.0 / 60.0;  // seconds
  std::vector<ScenarioShape> shapes;
  Scalar scalar = Scalar::Float;  // of [pipeline]; every pair's settings have the same
  PipelineSettings pipeline;      // [pipeline]
  std::vector<ScenarioPair> pairs;
  std::vector<ScenarioPatch> patches;  // of a file that has these instead of shapes and pairs
  std::string
      broad_phase;  // chooses the pairs of each frame, and none are listed; empty: none does
  WorldSettings world;
  SolverSettings solver;    // settled
  std::vector<View> views;  // at least one
  std::vector<Expectation> expectations;
  SnapshotSettings snapshots;
  std::vector<std::string> warnings;  // what a reader should know though nothing is wrong

  const ScenarioShape& shape(int index) const { return at(shapes, index); }
};

/// Whether a pair is two meshes that are asked themselves, so that both trees are gone through.
inline bool walks_trees(const Scenario& scenario, const ScenarioPair& pair) {
  const auto is_mesh = [&](int i) { return scenario.shape(i).is_mesh(); };
  return !pair.pipeline.makes_contacts() && !pair.pipeline.question.bounds && is_mesh(pair.a) &&
         is_mesh(pair.b);
}

/// Paths of all scenario files under a folder, sorted. Throws InputError where there is no such folder.
std::vector<std::string> scenario_files(const std::string& root);

/// Reads a scenario file. Throws InputError with line, column and remedy. Relative file names in it
/// are relative to its folder.
Scenario load_scenario(const std::string& path);

/// The same from text already read; `path` serves messages and relative file names.
Scenario parse_scenario(const std::string& text, const std::string& path);

/// The [[views]] of a scenario file, or of one that has nothing else; the rest is passed over.
std::vector<View> load_views(const std::string& path);

/// The view of a file that names none: fitted, with the default layers and no panels.
View default_view();

/// Pose of a shape at a time in seconds.
Pose<double> pose_at(const ScenarioShape& shape, double time);
/// The same of its collider.
Pose<double> collider_pose_at(const ScenarioShape& shape, double time);
/// What a trace tells where the collider has this pose, as the pipeline has it: that pose, or of a
/// moved shape its own, not rounded, because rounding would be multiplied by the distance.
Pose<double> recorded_pose(const ScenarioShape& shape, double time, const Pose<double>& collider);

}  // namespace contactscope
