#pragma once

#include "versus/comparison.h"

/// Evaluates bodies that each engine stepped by itself.
namespace contactscope::versus {

/// A dynamic body of a rollout request, as the reference for its motion in all engines.
struct RolloutBody {
  std::string name;
  double mass = 0;                         // kilograms
  Vec3d center = Vec3d::Zero();            // of mass, in the shape's frame, metres
  Eigen::Matrix3d inertia{};               // about it, the shape's axes, kg m^2
  Pose<double> start{};                    // world
  Vec3d velocity = Vec3d::Zero();          // of the centre at the start, m/s
  Vec3d angular_velocity = Vec3d::Zero();  // at the start, rad/s
  double thickness = 0;                    // metres: the shortest edge of its box
  bool rests = false;                      // rests at the start and should stay
};

/// The bodies of a request. A body rests if it does not move and a static shape or resting body
/// below it bears it. A gap of up to 1 % of the smaller shape counts as contact.
std::vector<RolloutBody> rollout_bodies(const trace::Trace& request);

/// One engine's rollout against exact geometry. Lists: per reported frame; metres, joules, seconds.
struct RolloutScore {
  std::string name;
  std::string failure;  // of the engine; or a body is lost or missing
  std::string refusal;  // the engine's own reason not to step (this scene); the rest is unset then
  std::vector<double> time;
  std::vector<double> height;  // of the highest centre of mass, against gravity, from the origin
  std::vector<double> energy;  // kinetic and potential, of all bodies; 0 at rest at the origin
  std::vector<double> penetration;  // of the deepest pair, >= 0
  std::vector<double> drift;        // of the resting body that is farthest from its start
  bool has_velocities = false;    // else energy uses differences of poses, which lag by half a step
  int resting = 0;                // bodies that should not move
  int fallen = 0;                 // of these: sank by half their thickness at some time
  std::optional<double> fell_at;  // seconds, of the first one
  std::string first_fallen;
  double worst_drift = 0;
  std::string drifted;  // the body
  double worst_penetration = 0;
  std::string worst_place;   // "frame 12, floor-crate"
  std::string unknown;       // "lower-thrown": first pair of unknown depth; empty: none
  int passed = 0;            // times that a body passed through another shape between frames
  std::string first_passed;  // "frame 2, bullet-plate"
  /// The largest rise of the energy above its previous minimum. Scripted shapes may add energy.
  double energy_gained = 0;
  double points = 0;  // mean number of active points per frame
  std::vector<lint::Finding> findings;
};

/// Frames are matched by number; shapes that an answer omits have the pose of the request. The
/// evaluation ends at the first frame in which a body's pose is missing or not finite.
RolloutScore judge_rollout(const trace::Trace& request, const EngineRun& engine_run);

}  // namespace contactscope::versus
