#pragma once

#include <random>

#include "dynamics/solver.h"
#include "trace/study.h"

namespace contactscope {

/// Cubes of one metre stacked on a plane; none leans so far that it could not stand forever.
struct StackPlan {
  struct Box {
    double x = 0, z = 0;  // metres, horizontal position of the centre
    double turn = 0;      // radians about the vertical axis
    double mass = 1;      // kilograms
  };
  std::vector<Box> boxes;  // from bottom to top
};

/// `count` >= 1 boxes of 1 kg, the highest of `ratio` kg; up to 2% off centre, 0.1 radians turned.
StackPlan stack_plan(std::mt19937_64& engine, int count, double ratio);

/// How a stack failed.
enum class StackFault {
  None,
  NotFinite,  // a position or velocity is not finite
  Energy,     // exceeds the initial energy by more than one frame of free fall
  Fallen,     // a box's centre is not over its support, or is more than half a box too low or high
};

/// Results of a stack that starts at rest in its final position, compared with the static solution:
/// every box at its height, overlapping the one below by the slop; every contact carries the weight
/// above it. Meaningless after a fault, except `frames` and `nanoseconds`.
struct StackOutcome {
  StackFault fault = StackFault::None;
  int frames = 0;                // until the fault, or all
  double penetration = 0;        // metres beyond the slop, of the deepest point in the last frame
  double worst_penetration = 0;  // likewise in any frame
  double drift = 0;              // metres: final offset of the highest box
  double jitter = 0;      // metres per second: fastest box (centre and corners), last second's mean
  double load_error = 0;  // relative to the weight above, worst contact, mean over the last second
  double ids_changed = 0;  // share of the points' ids that are new in a frame, last second
  double nanoseconds = 0;  // per frame, median of all frames
};

/// Common to all stacks of the study, with the friction of WorldPair.
inline constexpr int kStackFrames = 180;      // of 1/60 s
inline constexpr double kStackSlop = 0.005;   // metres; both as in Box2D for such boxes
inline constexpr double kStackMargin = 0.02;  // metres, speculative

/// Steps the stack in float, in a world of its own. The study's slop and speculative margin replace
/// those in `settings`. Keeps all contact points, or up to `max_points` of a pair. Deterministic
/// except for times, of whole frames or of finding contacts alone.
StackOutcome run_stack(const StackPlan& plan, SolverSettings settings, int frames = kStackFrames,
                       std::optional<int> max_points = {}, bool contacts_alone = false);

/// The method of `study solver` that may gain energy, as a counterexample.
inline constexpr const char* kAllPushKept = "Baumgarte, all of its push kept";

/// A scene whose energy a solver must not increase.
struct EnergyScene {
  std::string name;
  World<double> world;
  std::vector<Shape<double>> shapes;
  int frames = 120;  // of 1/60 s
  // Joules to remove the initial overlaps: each body is lifted until it lies on what is below, or
  // 0. Position correction may do this work, but no more.
  double lift = 0;
};

/// Twenty scenes: drops, deep starts, stacks, mass ratios, bullets. Floors are at height 0, so
/// energies are relative to the lowest positions of bodies.
std::vector<EnergyScene> energy_scenes();

/// Runs `scene` in double with `settings`. Returns the largest energy, kinetic and potential, of
/// any frame over the initial energy plus lift, minus 1; negative if energy was never gained. In
/// semi-implicit Euler velocities lag half a sub-step behind positions, so they are advanced by
/// gravity; else a rising ball would have more energy than a falling one.
double energy_gained(EnergyScene scene, const SolverSettings& settings);

}  // namespace contactscope
