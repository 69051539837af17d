#pragma once

#include "continuous/impact_of_shapes.h"
#include "core/key_table.h"
#include "dynamics/solver_settings.h"
#include "manifold/pair_query.h"
#include "view/view.h"
#include "view/words.h"

/// Contents of a scenario file, parsed and checked; scenarios/README.md documents the format.
namespace contactscope {

// Deformation of a mesh over time, own frame: motion.deform. The file has the rest shape.

/// A travelling sine: x + direction amplitude sin(2 pi (axis . x - speed t) / wavelength).
struct TravellingWave {
  Vec3d axis = Vec3d::UnitX();       // unit; the wave travels along it
  Vec3d direction = Vec3d::UnitY();  // unit; vertices move along it
  double amplitude = 0;              // metres
  double wavelength = 1;             // metres, > 0
  double speed = 0;                  // metres per second
};

/// Turns x about the axis through the origin by rate t (axis . x).
struct Twist {
  Vec3d axis = Vec3d::UnitY();  // unit
  double rate = 0;              // radians per metre along the axis and per second
};

/// Vertices at a time, as many as at rest; linear between keyframes, clamped outside.
struct VertexKeyframe {
  double time = 0;  // seconds
  std::vector<Vec3d> vertices;
};

using Deformation = std::variant<TravellingWave, Twist, std::vector<VertexKeyframe>>;

/// Positions of the vertices `at_rest` at a time in seconds. Keyframes replace all vertices.
std::vector<Vec3d> deformed_vertices(const Deformation& deformation,
                                     const std::vector<Vec3d>& at_rest, double time);

/// Pose at a time; keys that are left out come from the keyframe before, or the shape.
struct Keyframe {
  double time = 0;  // seconds
  Pose<double> pose;
};

/// Scripted motion: keyframes (linear positions, slerp rotations, clamped ends), or constant
/// velocities from the shape's own pose, in world space, m/s and rad/s about its origin.
struct Motion {
  std::vector<Keyframe> keyframes;
  Vec3d velocity = Vec3d::Zero();
  Vec3d angular_velocity = Vec3d::Zero();
  std::shared_ptr<const Deformation> deformation{};  // null: rigid
};

/// A shape that the solver moves. Its density is uniform.
struct ScenarioBody {
  double mass = 1;                         // kilograms
  Vec3d velocity = Vec3d::Zero();          // metres per second, of the centre of mass, at the start
  Vec3d angular_velocity = Vec3d::Zero();  // radians per second, world, at the start
};

struct ScenarioShape {
  std::string name;
  std::string type;  // "box", "hull", "cylinder", "cone", "sphere", "capsule", "plane", "mesh"
  std::shared_ptr<const Shape<double>> geometry;  // as in the file
  Pose<double> pose;
  Motion motion;
  std::optional<ScenarioBody> body{};  // empty: it moves by `motion`
  // A contact uses the geometric mean of both shapes' friction, and the larger restitution.
  std::optional<double> friction{};     // default: the world's
  std::optional<double> restitution{};  // default: the world's
  double weld = kSeam;                  // of a hull, see PlacedSurface; a mesh has its own

  /// The shape that is rounded and collided: `geometry`, or, if that is far from its own origin, or
  /// a sphere with a `center`, the same shape about its centre (see shape.h), which is at
  /// `collider_origin` in the file's frame, metres. Traces contain shapes and poses as in the file.
  std::shared_ptr<const Shape<double>> collider{};
  Vec3d collider_origin = Vec3d::Zero();
  TreeUpdate tree = TreeUpdate::Auto;  // of a deforming mesh

  /// The solver moves it.
  bool dynamic() const { return body.has_value(); }
  bool deforms() const { return motion.deformation != nullptr; }
  bool is_moved() const { return !collider_origin.isZero(0); }
  bool is_mesh() const { return kind_of(*geometry) == ShapeKind::Mesh; }
  /// nullptr if the shape is not a hull.
  const Hull<double>* hull() const { return std::get_if<Hull<double>>(geometry.get()); }
};

enum class Scalar { Float, Double };

/// Gregorius 2015, "Incremental vs One-Shot Manifold".
enum class ManifoldKind { OneShot, Incremental };

/// Where a query of two meshes' trees, or GJK, starts.
enum class Traversal {
  FromRoots,
  Coherent,  // where the previous frame's ended
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
  MeshManifolds mesh_manifolds = MeshManifolds::Pair;
  int triangle = -1;  // of a mesh: the one whose stages are recorded; -1: the deepest
  PenetrationMethod penetration = PenetrationMethod::Sat;
  ManifoldKind manifold = ManifoldKind::OneShot;
  IncrementalSettings incremental;
  /// Method for shapes that meet in the step after each frame; none for "discrete".
  std::optional<ImpactMethod> continuous{};
  Traversal traversal = Traversal::FromRoots;  // for queries of two meshes
  Question question;  // default: the manifold; its penetration method is `penetration`

  /// Whether solver and reducers get the pair's contacts.
  bool makes_contacts() const { return question.kind == QueryKind::Manifold; }
  friend bool operator==(const PipelineSettings&, const PipelineSettings&) = default;
};

/// Why this method cannot compute the time of impact of two shapes; empty if it can.
std::optional<std::string> impact_refusal(const ScenarioShape& a, const ScenarioShape& b,
                                          ImpactMethod method);

/// Two shapes to collide, as indices, with the settings of [pipeline] and its [[pairs]] entry.
struct ScenarioPair {
  int a = 0;
  int b = 0;
  std::string label;  // distinguishes entries for the same two shapes
  PipelineSettings pipeline;
};

/// Given contact points, from a [[patch]]: there are no shapes, only a reduction to run.
struct ScenarioPatch {
  std::string name;
  Vec3d normal = Vec3d::UnitY();               // unit, from a to b
  std::vector<ContactPoint<double>> points{};  // world; at least one
};

/// One [[expect]] entry, which `check` tests for a pair over a range of frames.
struct Expectation {
  int first_frame = 0;
  int last_frame = 0;  // inclusive
  int a = 0;
  int b = 0;
  std::string label;
  std::optional<std::string> state;  // "touching", "separated"
  std::optional<bool> overlap;       // for a pair with a query
  std::optional<bool> touching;      // for a "touching" query
  std::optional<int> intersections;  // pairs of triangles of two meshes that share a point
  std::optional<int> points;
  std::optional<std::string> axis;  // "face_a", "face_b", "edge_edge", "closest_points"
  std::optional<std::string> type;  // "point-face", ...
  std::optional<Vec3d> normal;
  std::optional<double> separation;   // metres, deepest point
  std::optional<double> load;         // newtons, from the solver's normal impulses
  std::optional<std::string> impact;  // "hit", ...: in the step after the frame
  std::optional<double> impact_time;  // fraction of that step
  std::optional<int> ghosts;          // speculative points of shapes that would not meet
  std::optional<int> stops;           // of the two shapes, by the solver, in that step
  std::optional<bool> asleep;         // the bodies of the pair, during that step
  double tolerance = 1e-5;            // metres, and per component of the normal; share of the load
  int line = 0;                       // in the file, for messages
};

/// Allowed differences from the stored picture; defaults are in render/image/compare.h.
struct PictureLimits {
  std::optional<int> channel, cluster, total;
};

/// Which frames `check` stores, their size, and the tolerances.
struct SnapshotSettings {
  std::vector<int> frames;  // default: first, middle, last
  int width = 640;
  int height = 360;
  PictureLimits limits{};
  std::map<std::string, PictureLimits> view_limits{};  // by view name
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
  Scalar scalar = Scalar::Float;  // from [pipeline], the same for every pair
  PipelineSettings pipeline;      // [pipeline]
  std::vector<ScenarioPair> pairs;
  std::vector<ScenarioPatch> patches;  // replace shapes and pairs in a file of patches
  std::string
      broad_phase;  // selects the pairs of each frame, which are then not listed; empty: none
  WorldSettings world;
  SolverSettings solver;    // adjusted to the shapes
  std::vector<View> views;  // at least one
  Words words{};            // of pictures
  std::vector<Expectation> expectations;
  SnapshotSettings snapshots;
  std::vector<std::string> warnings;  // for what is suspicious but not an error

  const ScenarioShape& shape(int index) const { return at(shapes, index); }
};

/// Whether the method of a pair's query has a start to choose: the trees of two meshes, or GJK.
inline bool starts_somewhere(const Scenario& scenario, const ScenarioPair& pair) {
  const auto kind = [&](int i) { return kind_of(*scenario.shape(i).geometry); };
  const auto both = [&](auto low, auto high) {
    return std::min(kind(pair.a), kind(pair.b)) >= low &&
           std::max(kind(pair.a), kind(pair.b)) <= high;
  };
  return !pair.pipeline.makes_contacts() && !pair.pipeline.question.bounds &&
         (both(ShapeKind::Sphere, ShapeKind::Hull) || both(ShapeKind::Mesh, ShapeKind::Mesh));
}

/// "<group>/<idea>": the folder and the name of a scenario file.
std::string scenario_name(const std::string& path);

/// Paths of the scenario files in a folder, sorted. Throws InputError if it does not exist.
std::vector<std::string> scenario_files(const std::string& root, const char* ending = ".toml");

/// Reads a scenario; file names are relative to its folder. Throws InputError with the remedy.
Scenario load_scenario(const std::string& path);

/// The same from text; `path` is for messages and relative file names.
Scenario parse_scenario(const std::string& text, const std::string& path);

/// The [[views]] of a scenario file or of a file with only views; other keys are ignored.
std::vector<View> load_views(const std::string& path);

/// The view of a file without views: fitted, with the default layers and no panels.
View default_view();

/// Pose of a shape at a time in seconds.
Pose<double> pose_at(const ScenarioShape& shape, double time);
/// Pose of its collider.
Pose<double> collider_pose_at(const ScenarioShape& shape, double time);
/// The pose to trace for a collider's pose in the pipeline: the same pose, or, for a moved shape,
/// its own pose without rounding, which would be multiplied by the distance.
Pose<double> recorded_pose(const ScenarioShape& shape, double time, const Pose<double>& collider);

/// Names of a scenario that appear in pictures: of shapes and their kinds, and labels of pairs.
std::vector<std::string_view> names_in_pictures(const Scenario& scenario);

/// The [words] table of a file, which may contain more; empty without one. `names` can be replaced
/// in addition to the built-in texts. Throws InputError.
Words load_words(const std::string& path, const std::vector<std::string_view>& names);

namespace scenario_file {

/// The keys of scenario files. The tables are those of scenarios/README.md, which is built in.
const std::vector<KeyTable>& key_tables();

/// The table of a name: "The file", "solver", "Box", "rotation".
const KeyTable& key_table(std::string_view name);

}  // namespace scenario_file

}  // namespace contactscope
