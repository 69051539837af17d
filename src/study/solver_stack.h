#pragma once

#include <random>
#include <vector>

#include "dynamics/solver_settings.h"
#include "trace/study.h"

namespace contactscope {

/// Cubes of one metre on a plane, one on another, as exact numbers: none leans so far that it could
/// not stand for ever.
struct StackPlan {
  struct Box {
    double x = 0, z = 0;  // metres, of the centre, sideways
    double turn = 0;      // radians about the vertical
    double mass = 1;      // kilograms
  };
  std::vector<Box> boxes;  // from the lowest to the highest
};

/// `count` (>= 1) boxes of 1 kg, the highest of `ratio` kg; each up to 2% of its width off the middle
/// and turned by up to 0.1 radians.
StackPlan stack_plan(std::mt19937_64& engine, int count, double ratio);

/// How a stack came to grief.
enum class StackFault {
  None,
  NotFinite,  // a place or velocity that is no number
  Energy,     // more than at the start, by more than one frame of free fall gives to all of it
  Fallen,     // a box whose centre is not over its support, or more than half a box too low or high
};

/// What became of a stack that was set down without motion where it should stay, against the static
/// solution: every box at its height, overlapping what is below by the slop; every contact carries
/// the weight above it. Meaningless after a fault, but for `frames` and `nanoseconds`.
struct StackOutcome {
  StackFault fault = StackFault::None;
  int frames = 0;                // until the fault, or all
  double penetration = 0;        // metres beyond the slop, the deepest point in the last frame
  double worst_penetration = 0;  // likewise in any frame
  double drift = 0;              // metres: how far the highest box is from its place at the end
  double jitter = 0;  // metres a second: fastest box (of centre and corners), last second's mean
  double load_error = 0;   // of the weight above, worst contact, last second's mean
  double ids_changed = 0;  // share of the points' ids that the frame before had not, last second
  double nanoseconds = 0;  // of a frame: contacts and solver, the median of all frames
};

/// What all stacks of the study share, beside the friction of WorldPair.
inline constexpr int kStackFrames = 180;      // of a sixtieth of a second
inline constexpr double kStackSlop = 0.005;   // metres; both as Box2D has them for such boxes
inline constexpr double kStackMargin = 0.02;  // metres, speculative

/// Steps the stack in float with a world of its own. Of `settings` the slop and the speculative
/// margin are replaced by the study's. Deterministic but for the time.
StackOutcome run_stack(const StackPlan& plan, SolverSettings settings, int frames = kStackFrames);

}  // namespace contactscope
