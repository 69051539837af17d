#pragma once

#include <optional>
#include <string>
#include <vector>

#include "versus/comparison.h"

/// What became of bodies that each engine stepped by itself.
namespace contactscope::versus {

/// A dynamic body of a request for a rollout: what its motion is judged by, whatever an engine says of it.
struct RolloutBody {
  std::string name;
  double mass = 0;                         // kilograms
  Vec3d center = Vec3d::Zero();            // of mass, in the shape's frame, metres
  Eigen::Matrix3d inertia{};               // about it, the shape's axes, kg m^2
  Pose<double> start{};                    // world
  Vec3d velocity = Vec3d::Zero();          // at the start, of the centre, m/s
  Vec3d angular_velocity = Vec3d::Zero();  // at the start, rad/s
  double thickness = 0;                    // metres: the shortest edge of its box
  bool rests = false;                      // it stands at the start, and should stay
};

/// The bodies of a request. One rests that is not moving and that what stands below bears: it touches, itself or
/// by others that rest, a shape that is not dynamic. Of contacts a gap of 1 % of the smaller shape is one.
std::vector<RolloutBody> rollout_bodies(const trace::Trace& request);

/// One engine's rollout, held against exact geometry. Lists have an entry for each frame that it told, in their
/// order; metres, joules, seconds.
struct RolloutScore {
  std::string name;
  std::string failure;  // as of the contender, or that a body is lost or is nowhere
  std::string
      refusal;  // the engine steps nothing, or not this: its own words; then there is nothing below
  std::vector<double> time;
  std::vector<double> height;  // of the highest centre of mass, against gravity, from the origin
  std::vector<double>
      energy;  // kinetic and potential, of all bodies; 0 for one at rest at the origin
  std::vector<double> penetration;  // deepest of all pairs of shapes, >= 0
  std::vector<double> drift;        // of the body that rests and is farthest from its start
  bool has_velocities =
      false;        // else energy is of the differences of poses, which lag by half a step
  int resting = 0;  // bodies that should stay where they are
  int fallen = 0;   // of these: they sank by half of their thickness, ever
  std::optional<double> fell_at;  // the first of them, seconds
  std::string first_fallen;
  double worst_drift = 0;
  std::string drifted;  // the body
  double worst_penetration = 0;
  std::string worst_place;  // "frame 12, floor-crate"
  std::string
      unknown;  // "lower-thrown": the first two of which nobody knows how deep they are; empty: none
  int passed = 0;            // bodies that went through another shape between two frames, each time
  std::string first_passed;  // "frame 2, bullet-plate"
  /// The most that the energy rose above any that it had before. Bodies that scripted shapes move may gain some.
  double energy_gained = 0;
  double points = 0;  // a frame, in the mean: those that act
  std::vector<lint::Finding> findings;
};

/// Frames are those of the request by number; a shape that a frame of an answer does not have is where the
/// request has it. The first frame without a pose of a body, or with one that is not finite, ends the judging.
RolloutScore judge_rollout(const trace::Trace& request, const EngineRun& engine_run);

}  // namespace contactscope::versus
