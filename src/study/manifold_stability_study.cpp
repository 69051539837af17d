#include "study/manifold_stability_study.h"

#include "dynamics/sleep.h"
#include "geometry/primitives.h"
#include "manifold/incremental_patch.h"
#include "study/random_cases.h"
#include "study/solver_stack.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr int kLandingFrames = 150;
constexpr int kLandingCases = 20;
constexpr int kLandingRepetitions = 5;
constexpr float kFrame = 1.0F / 60;
constexpr double kDegrees = 180 / std::numbers::pi;
// Rotation below the accumulated rounding of single precision.
constexpr double kRotationResolution = 1e-3;
constexpr double kWanderResolution = 1e-4;

const Pose<float> kFloor{Quat<float>::Identity(), Vec3<float>(0, -0.5F, 0)};

/// A box on the floor, with the state that its method keeps between frames.
struct LandingPair {
  Shape<float> floor, box;
  LandingMethod method;
  CollideOptions options;
  IncrementalOptions incremental;
  PairCache<float> cache;
  PersistentManifold<float> persistent;
  Manifolds<float> manifolds;

  LandingPair(const LandingCase& c, LandingMethod by)
      : floor(shape_cast<float>(make_box(Vec3d(20, 0.5, 20)))),
        box(shape_cast<float>(make_box(c.half_extents))),
        method(by) {
    options.reducer = find_reducer("area");
    incremental.settings.confirm = by == LandingMethod::ByIds ? Confirm::Ids : Confirm::Distance;
  }
  void collide_at(const Pose<float>& box_pose) {
    if (method == LandingMethod::OneShot)
      collide(floor, kFloor, box, box_pose, options, manifolds, &cache);
    else
      collide_incremental(floor, kFloor, box, box_pose, options, incremental, persistent,
                          manifolds);
  }
};

Pose<double> start_of(const LandingCase& c) {
  constexpr double kGap = 1e-3;
  Pose<double> pose;
  pose.rotation = Quatd(Eigen::AngleAxisd(c.yaw, Vec3d::UnitY()));
  const double height = c.landing == Landing::Drop ? c.parameter : kGap;
  double lowest = -c.half_extents.y();
  if (c.landing == Landing::Tilt) {
    pose.rotation = pose.rotation * Quatd(Eigen::AngleAxisd(c.parameter, Vec3d::UnitX()));
    lowest =
        -c.half_extents.y() * std::cos(c.parameter) - c.half_extents.z() * std::sin(c.parameter);
  }
  pose.position = Vec3d(0, height - lowest, 0);
  return pose;
}

/// Degrees of rotation that symmetry excludes: all of it for a drop; for a tilt that of the axis
/// along its edge; for a slide, which may pitch, that of the horizontal axis across it.
double impossible_rotation(const LandingCase& c, const Quatd& from, const Quatd& to) {
  if (c.landing == Landing::Drop) return from.angularDistance(to) * kDegrees;
  const Vec3d kept = c.landing == Landing::Tilt ? Vec3d::UnitX() : Vec3d::UnitZ();
  const Vec3d before = from * kept, after = to * kept;
  return std::atan2(before.cross(after).norm(), before.dot(after)) * kDegrees;
}

/// Tracks the manifold from frame to frame.
struct LandingWatch {
  double size;  // metres, of the box
  LandingOutcome& outcome;
  int frames = 0;                 // since the first contact
  std::optional<Vec3d> before{};  // mean of the contact points, in the box

  void look(const Manifolds<float>& manifolds, const Body<float>& body) {
    if (manifolds.empty() && !before) return;
    ++frames;
    if (manifolds.empty()) return;
    std::vector<Vec3d> points;
    Vec3d middle = Vec3d::Zero();
    for (const ContactPoint<float>& point : manifolds[0].points) {
      points.push_back(point.position.cast<double>());
      middle += points.back() / static_cast<double>(manifolds[0].points.size());
    }
    const Vec3d center = body.center.cast<double>();
    const double rounding =
        rounding_of(points, center, static_cast<double>(std::numeric_limits<float>::epsilon()));
    const trace::Stability resting =
        rest_of(points, manifolds[0].normal.cast<double>(), center, rounding);
    if (outcome.frames_to_stable == 0 && resting.verdict == "stable")
      outcome.frames_to_stable = frames;
    const Vec3d in_box = body.pose().cast<double>().inverse_transform(middle);
    if (before) outcome.wander += Vec3d(in_box - *before).norm() / size;
    before = in_box;
  }
};

struct LandingPanel {
  Landing landing;
  const char* parameter;
  double values[7];
};

constexpr LandingPanel kLandingPanels[] = {
    {Landing::Drop, "drop: height (m)", {1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1}},
    {Landing::Tilt, "tilt: angle (rad)", {1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1}},
    {Landing::Slide, "slide: speed (m/s)", {0.1, 0.2, 0.5, 1, 2, 5, 10}},
};

constexpr const char* kLandingMethods[] = {"one-shot", "incremental by distance",
                                           "incremental by ids"};

LandingCase random_landing(std::mt19937_64& engine, Landing landing, double parameter) {
  LandingCase c{landing, parameter};
  for (int axis = 0; axis < 3; ++axis) c.half_extents[axis] = uniform(engine, 0.2, 0.5);
  // Low enough not to topple while friction stops it.
  c.half_extents.y() = std::min(c.half_extents.y(), c.half_extents.x());
  c.yaw = uniform(engine, 0, std::numbers::pi / 2);
  return c;
}

/// Tests every method on the same boxes at one parameter.
Measurement judge(const LandingPanel& panel, double parameter, LandingMethod method,
                  const StudyOptions& options) {
  Measurement measured(3, options.cases.value_or(kLandingCases));
  std::mt19937_64 engine(options.seed);
  for (int i = 0; i < measured.of; ++i) {
    const LandingCase c = random_landing(engine, panel.landing, parameter);
    const LandingOutcome outcome = land(c, method, kLandingFrames);
    if (outcome.frames_to_stable > 0)
      measured.errors[0].add(outcome.frames_to_stable);
    else
      ++measured.failed;
    measured.errors[1].add(std::max(outcome.rotation, kRotationResolution));
    measured.errors[2].add(std::max(outcome.wander, kWanderResolution));
    const int repetitions = i == 0 ? options.repetitions.value_or(kLandingRepetitions) : 0;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      LandingPair pair(c, method);
      measured.times.measure(count_of(outcome.poses), [&](int frame) {
        pair.collide_at(at(outcome.poses, frame));
        return static_cast<double>(pair.manifolds.size());
      });
    }
  }
  return measured;
}

constexpr double kDropHeights[] = {0.1, 0.3, 1, 3, 10};  // metres
constexpr int kDeepCalls = 200;

/// A query of the cores: GJK while they are separated, otherwise the method for the depth.
struct CoreMethod {
  const char* name;
  std::optional<PenetrationMethod> deep{};
};
constexpr CoreMethod kCoreMethods[] = {{"GJK"},
                                       {"separating axis test", PenetrationMethod::Sat},
                                       {"EPA", PenetrationMethod::Epa},
                                       {"MPR", PenetrationMethod::Mpr},
                                       {"sampling", PenetrationMethod::Sampling}};

/// Catto 2007, "Deep Contact": the share of touching frames that need the query, and its time.
Measurement judge_queries(double height, const CoreMethod& method, const StudyOptions& options) {
  Measurement measured(1, options.cases.value_or(kLandingCases));
  std::mt19937_64 engine(options.seed);
  for (int i = 0; i < measured.of; ++i) {
    const LandingCase c = random_landing(engine, Landing::Drop, height);
    LandingPair pair(c, LandingMethod::ByDistance);
    pair.collide_at(start_of(c).cast<float>());  // makes the cores
    const ShapeCore<float>&floor = *pair.persistent.core_a, &box = *pair.persistent.core_b;
    const float margins = floor.margin + box.margin;
    const auto query = [&](const Pose<float>& pose) {
      return query_cores<float>(floor, box, relative_pose(kFloor, pose),
                                method.deep.value_or(PenetrationMethod::Sat), nullptr, nullptr);
    };
    const LandingOutcome outcome = land(c, LandingMethod::ByDistance, kLandingFrames);
    int touching = 0, needed = 0;
    for (const Pose<float>& pose : outcome.poses) {
      const auto found = query(pose);
      if (!found || found->distance > margins) continue;
      ++touching;
      needed += found->overlap == method.deep.has_value() ? 1 : 0;
    }
    measured.errors[0].add(static_cast<double>(needed) / std::max(touching, 1));
    Pose<float> pose = outcome.poses.back();
    if (method.deep) pose.position.y() -= 2 * margins;
    measured.times.measure(kDeepCalls, [&](int) {
      return static_cast<double>(query(pose).value_or(CoreQuery<float>{}).distance);
    });
  }
  return measured;
}

}  // namespace

LandingOutcome land(const LandingCase& c, LandingMethod method, int frames) {
  LandingPair pair(c, method);
  const Pose<double> start = start_of(c);
  const MassProperties filled = *mass_properties(pair.box);
  std::vector<Body<float>> bodies{
      static_body<float>(kFloor),
      dynamic_body<float>(start.cast<float>(), with_mass(filled, 1000 * filled.mass))};
  Body<float>& body = bodies[1];
  if (c.landing == Landing::Slide)
    body.velocity = start.rotate(Vec3d(c.parameter, 0, 0)).cast<float>();
  SolverSettings settings;
  settings.slop = kStackSlop;
  settings.speculative_margin = 0;  // frames count from the first touch
  LandingOutcome outcome;
  LandingWatch watch{std::max(c.half_extents.x(), c.half_extents.z()), outcome};
  std::vector<PairImpulses<float>> impulses;
  const Vec3<float> gravity(0, -9.81F, 0);
  for (int frame = 0; frame < frames; ++frame) {
    outcome.poses.push_back(body.pose());
    pair.collide_at(body.pose());
    watch.look(pair.manifolds, body);
    const PairContacts<float> contacts{0, 1, &pair.manifolds, 0.6F, 0};
    solve_step<float>(bodies, {&contacts, 1}, impulses, gravity, settings, kFrame);
    outcome.rotation = std::max(
        outcome.rotation, impossible_rotation(c, start.rotation, body.rotation.cast<double>()));
  }
  return outcome;
}

/// Compares one-shot manifolds with incremental ones by distance and by ids, for boxes that drop,
/// land on an edge, and slide. Measures from Gregorius 2015, "Building Incremental Manifolds (2)"
/// and (3) and "Incremental Manifold Stability": frames to a stable manifold ("frames"), artificial
/// rotation ("rotation"), and drift of the patch ("wander"). Run time is per pair and frame. A case
/// fails if its manifold never becomes stable.
///
/// "queries": Catto 2007, "Deep Contact": of the frames in which a dropped box touches the floor, the
/// share in which GJK suffices, because the cores are separated, and that in which a method for the depth
/// is needed, over the height; run time is of a query.
std::vector<trace::Study> study_manifold_stability(const StudyOptions& options,
                                                   const StudyProgress& progress) {
  std::vector<trace::Study> results = results_of(
      "manifold_stability", "float", "parameter of the landing",
      "symmetry; " + std::to_string(options.cases.value_or(kLandingCases)) + " boxes a point, " +
          std::to_string(kLandingFrames) + " frames" + options.seeded(),
      {{"frames", "Frames until the manifold is stable", "frames to a stable manifold"},
       {"rotation", "Rotation that the motion cannot have by symmetry",
        "artificial rotation (degrees)", "", kRotationResolution},
       {"wander", "How the middle of the contact patch wanders",
        "way of the patch / half length of the box", "", kWanderResolution}},
      trace::StudyForm::Curves);
  const StudyStep step =
      counted(progress, static_cast<int>(std::size(kLandingPanels) * std::size(kLandingMethods) +
                                         std::size(kCoreMethods)));
  for (const LandingPanel& panel : kLandingPanels) {
    for (int m = 0; m < 3; ++m) {
      add_line(results, {kLandingMethods[m], {}, panel.parameter, panel.parameter}, panel.values,
               [&](double value) {
                 return judge(panel, value, static_cast<LandingMethod>(m), options);
               });
      step(std::string(panel.parameter) + ", " + kLandingMethods[m]);
    }
  }
  std::vector<trace::Study> queries =
      results_of("manifold_stability", "float", "height of the drop (m)",
                 std::to_string(options.cases.value_or(kLandingCases)) + " boxes a point, " +
                     std::to_string(kLandingFrames) + " frames, margins of 2 cm" + options.seeded(),
                 {{"queries", "How often boxes that touch are deeper than their margins",
                   "share of the touching frames", trace::kShare}},
                 trace::StudyForm::Curves);
  for (const CoreMethod& method : kCoreMethods) {
    add_line(queries, {method.name, {}}, kDropHeights,
             [&](double height) { return judge_queries(height, method, options); });
    step(std::string("queries, ") + method.name);
  }
  record::drop_worst(queries.front());  // a share has none
  results.push_back(std::move(queries.front()));
  return results;
}

}  // namespace contactscope
