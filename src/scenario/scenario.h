#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/penetration_method.h"
#include "core/pose.h"
#include "core/preference.h"
#include "core/view.h"
#include "dynamics/solver_settings.h"
#include "geometry/shape.h"
#include "manifold/collide_options.h"
#include "manifold/incremental_settings.h"

/// The scenario format of FORMATS.md, and what it has grown since:
///
///     [shapes.crate]
///     merge_coplanar = true            # of box, hull, cylinder, cone; false: faces are left in
///                                      # triangles, and clipping sees one of them
///
///     [pipeline]
///     preference = "relative"          # or "none": the axis of true minimum penetration
///     penetration = "sat"              # or "epa", "mpr", "sampling": of hulls that overlap, how
///                                      # their depth and normal are found
///     manifold = "one-shot"            # or "incremental": a point a frame by GJK on the cores; of
///                                      # spheres, capsules, hulls and planes, not of meshes
///     core_margin = 0.02               # metres; incremental: how far a hull's core lies inside
///     breaking_distance = 0.02         # metres; incremental: places farther apart are dismissed,
///                                      # new points nearer than that to an old one replace it
///     confirm = "distance"             # or "ids"; incremental: how old points are confirmed
///     internal_edges = true            # false: meshes trip over edges that the surface lacks
///     degenerate = "fallback"          # or "skip": what to do where geometry gives no normal
///
///     [[pairs]]                        # several settings for the same two shapes, told apart
///     a = "crate"                      # by their labels
///     b = "floor"
///     label = "preference off"         # once a second entry names the same two shapes
///     preference = "none"              # and any other key of [pipeline] but scalar
///
///     [[views]]
///     focus = "contact"                # or "shapes": what the fitted camera frames
///     kind  = "contact_plane"          # or "scene": one cell a pair, its reduction seen along the
///                                      # normal; pairs of the same shapes with different reducers
///                                      # stand side by side
///     choices = 3                      # of a contact plane: so many choices, and what the last one
///                                      # was made by; 0: the result
///     impulse_scale = 0.05             # metres of an arrow for one newton second, where loads are
///                                      # shown for one newton; default: fitted to the sequence
///     layers = ["impulses", "loads"]   # loads: arrows are forces over the frame's time, and each
///                                      # pair says the sum of its normal ones; friction: at a
///                                      # scale of its own; masses; relative_velocity: of the two
///                                      # bodies at their contact; ahead: where bodies would be
///                                      # a frame later if nothing stopped them; overlap: how deep
///                                      # each pair is
///     story = "clip_steps"             # frame k shows k side planes; "none": all of them
///
///     [[expect]]
///     label = "preference off"         # of the pair
///     axis  = "face_b"                 # or "face_a", "edge_edge", "closest_points"
///     type  = "point-face"             # which features touch, the simpler one first
///
///     [snapshots]
///     frames = [0, 11, 23]             # that `check` stores; default first, middle, last
///     size   = [640, 360]              # pixels
///
/// Lengths may be 1e-9 to 1e9 metres, frames up to 100000, segments 3 to 64, max_points 1 to 64,
/// pairs up to 4096, points of a hull up to 100000, the file up to 16 MiB. `segments` has no
/// default. A view's name becomes a folder: letters, digits, '_' and '-'.
///
///     [shapes.crate]
///     friction    = 0.6                # of contacts: the geometric mean of both shapes'; default
///     restitution = 0.0                # the world's; of contacts: the larger of both shapes'
///
///     [shapes.crate.motion]
///     dynamic = true                   # moved by the solver; not planes and meshes
///     mass    = 1.0                    # kilograms, or density = kilograms a cubic metre
///     velocity = [0, 0, 0]             # at the start, of the centre of mass; and angular_velocity
///
///     [world]
///     gravity     = [0, -9.81, 0]      # default along `up`
///     friction    = 0.6
///     restitution = 0.0
///
///     [solver]
///     iterations = 10                  # sweeps over all points in each sub-step
///     substeps   = 1                   # of each frame
///     position_correction = "baumgarte"  # or "projection", "soft"
///     warm_start = true
///     baumgarte  = 0.1                 # share of the overlap that a sub-step works off
///     hertz      = 30.0                # of soft contacts, and damping_ratio = 10.0
///     slop       = 0.005               # metres of overlap that are let be; default 1/200 of the
///                                      # smallest dynamic shape, 5 mm of a crate of a metre
///     speculative_margin = 0.02        # metres: points up to that far apart are kept, and keep
///                                      # bodies from passing through each other; default 1/50
///
///     [[expect]]
///     load = 98.1                      # newtons: normal impulses of the frame over its time;
///                                      # `tolerance` is a share of it
///
/// The smallest shape is the one of which the box that has its mass and inertia has the shortest
/// edge; with slop = 0.0 and speculative_margin = 0.0 contacts come and go, and nothing rests.
///
/// Where shapes are dynamic, frame k shows them before step k, the contacts found there, and the
/// impulses that the step then gives; pairs of which no shape is dynamic are left out by default. Of
/// several entries for the same two shapes the first one moves them, the others are only shown.
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
  std::shared_ptr<const Shape<double>> geometry;
  Pose<double> pose;
  Motion motion;
  std::optional<ScenarioBody> body{};  // empty: it moves as `motion` says
  // Of a contact the friction is the geometric mean of both shapes', the restitution the larger.
  std::optional<double> friction{};     // default: the world's
  std::optional<double> restitution{};  // default: the world's

  /// nullptr for shapes that are no hulls.
  const Hull<double>* hull() const { return std::get_if<Hull<double>>(geometry.get()); }
};

enum class Scalar { Float, Double };

/// Gregorius 2015, "Incremental vs One-Shot Manifold".
enum class ManifoldKind { OneShot, Incremental };

struct PipelineSettings {
  Scalar scalar = Scalar::Float;
  std::string reducer = "area";
  int max_points = 4;
  double margin = 0;  // metres
  bool cache = true;
  Preference preference = Preference::Relative;
  Degenerate degenerate = Degenerate::Fallback;
  bool internal_edges = true;
  PenetrationMethod penetration = PenetrationMethod::Sat;
  ManifoldKind manifold = ManifoldKind::OneShot;
  IncrementalSettings incremental;

  friend bool operator==(const PipelineSettings&, const PipelineSettings&) = default;
};

/// Two shapes to collide, by index into Scenario::shapes, with the settings for this pair: those of
/// [pipeline], overridden by the keys of the [[pairs]] entry.
struct ScenarioPair {
  int a = 0;
  int b = 0;
  std::string label;  // tells apart entries that name the same two shapes
  PipelineSettings pipeline;
};

enum class ExpectedState { Touching, Separated };

/// One [[expect]] entry: what `check` asks of a pair over a range of frames.
struct Expectation {
  int first_frame = 0;
  int last_frame = 0;  // inclusive
  int a = 0;
  int b = 0;
  std::string label;
  std::optional<ExpectedState> state;
  std::optional<int> points;
  std::optional<std::string> axis;  // "face_a", "face_b", "edge_edge", "closest_points"
  std::optional<std::string> type;  // "point-face", ...
  std::optional<Vec3d> normal;
  std::optional<double> separation;  // metres, deepest point
  std::optional<double> load;        // newtons, what the solver's normal impulses come to
  double tolerance = 1e-5;  // metres, and for each component of the normal; share of the load
  int line = 0;             // in the file, for messages
};

/// Which frames `check` stores, and in what size.
struct SnapshotSettings {
  std::vector<int> frames;  // default: first, middle, last
  int width = 640;
  int height = 360;
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
  std::vector<ScenarioPair> pairs;
  WorldSettings world;
  SolverSettings solver;    // settled
  std::vector<View> views;  // at least one
  std::vector<Expectation> expectations;
  SnapshotSettings snapshots;
  std::vector<std::string> warnings;  // what a reader should know though nothing is wrong
};

/// Reads a scenario file. Throws InputError with line, column and remedy; FORMATS.md lists what is
/// wrong with a file. Relative file names in it are relative to its folder.
Scenario load_scenario(const std::string& path);

/// The same from text already read; `path` serves messages and relative file names.
Scenario parse_scenario(const std::string& text, const std::string& path);

/// Pose of a shape at a time in seconds.
Pose<double> pose_at(const ScenarioShape& shape, double time);

}  // namespace contactscope
