#pragma once

#include <vector>

#include "continuous/sweep.h"
#include "core/plane.h"
#include "query/support_set.h"

namespace contactscope {

enum class ImpactStatus {
  Separated,    // at no time of the step nearer than the tolerance
  Hit,          // at `time` within the tolerance, and never before
  Overlapping,  // at time 0 already, or so near that rounding cannot tell
  /// kMaxImpactSteps, or a motion so large that its rounding hides what is between the two; up to `time`
  /// they are apart for certain, what comes is not known.
  OutOfIterations,
};

/// "separated", "hit", "overlapping", "out_of_iterations".
constexpr const char* to_string(ImpactStatus status) {
  constexpr const char* kNames[] = {"separated", "hit", "overlapping", "out_of_iterations"};
  return kNames[static_cast<int>(status)];
}

/// A convex shape that moves: its core, and how far its surface is from the core.
template <class S>
struct MovingShape {
  SupportSet<S> core;
  Sweep<S> motion;
  S radius = 0;  // metres, of a sphere or a capsule
};

/// Everything below a plane, which moves.
template <class S>
struct MovingPlane {
  Plane<S> plane;  // of the shape's frame
  Sweep<S> motion;
};

template <class S>
struct ImpactResult {
  ImpactStatus status = ImpactStatus::OutOfIterations;
  S time = 0;  // fraction of the step; ImpactLimits::until when Separated
  /// Between the surfaces at `time`, metres. Where it is no Hit, the last that was measured, and 0 where
  /// none was.
  S distance = 0;
  /// Unit, from A to B, world, at `time`, of a Hit; where iterations ran out, as it was seen last.
  Vec3<S> normal = Vec3<S>::UnitX();
  Vec3<S> on_a =
      Vec3<S>::Zero();  // closest points of the surfaces at `time`, in the world; of a Hit
  Vec3<S> on_b = Vec3<S>::Zero();
  int steps = 0;   // distances measured; one that a cast ends with counts
  int bounds = 0;  // projections on an axis, support points of casts among them
};

/// One step of the search, for somebody who watches.
template <class S>
struct ImpactStep {
  S time;        // of the distance
  S distance;    // between the surfaces, metres
  Vec3<S> axis;  // unit, from A to B, world: along it the shapes are apart
  /// Of the last projection on the axis: when the separation along it was measured again, and what it
  /// was. By conservative advancement, which measures no second time, and of what does not turn, the
  /// fastest that they can come nearer: where the distance would be used up, and 0; or the end, of the
  /// step or of the time in which balls about them are near. By a cast, of which each support plane that
  /// brings the safe time on is a step: that time, and what is left.
  S bracket_end;
  S bracket_separation;
  S safe;  // until then they cannot meet
};

template <class S>
struct ImpactRun {
  ImpactResult<S> result;
  std::vector<ImpactStep<S>> steps;
};

/// A tenth of this are enough for all but shapes that glide past each other at about the tolerance, or
/// that spin many times while conservative advancement looks on.
inline constexpr int kMaxImpactSteps = 256;

/// How near is a hit: the larger one of both, and no less than 32 roundings of the pair's extent.
/// And until when one looks.
template <class S>
struct ImpactLimits {
  S gap = 0;  // metres
  /// Of the way that any point of one shape goes beside the other in the step, at most: what meets
  /// head on is told so much of the step too early at most.
  S of_motion = S(1e-5);
  S until = 1;  // fraction of the step, > 0
  /// Triangles of a mesh that overlap at the start are passed over; what comes later of others is told.
  /// For somebody who has contacts of those already.
  bool passes_overlaps = false;
};

/// The first time in a step at which two convex shapes are within the tolerance of each other. Shapes
/// that are nearer than that at the start hit when they have come to three quarters of where they
/// were.
///
/// Never late: at every time before `time` the shapes are apart, rotations of any size included. How
/// early it is depends on the tolerance alone: the surfaces are nearer than it at `time`. Motions are
/// subtracted before anything else is computed, so that nothing is lost far from the origin but what
/// the coordinates have lost already.
///
/// Balls about both say when one has to look at all. Polyhedra are cast against each other from there
/// (foresee_impact.h). Then, and of what is round at once, by the root of the separation along the axis
/// that GJK names: exactly where nothing turns, else by a bound between now and where the nearest points
/// would meet. `run`: null when nobody watches.
template <class S>
ImpactResult<S> time_of_impact(const MovingShape<S>& a, const MovingShape<S>& b,
                               const ImpactLimits<S>& allowed = {}, ImpactRun<S>* run = nullptr);
template <class S>
ImpactResult<S> time_of_impact(const MovingPlane<S>& a, const MovingShape<S>& b,
                               const ImpactLimits<S>& allowed = {}, ImpactRun<S>* run = nullptr);

/// The same by the distance over the fastest that any two points can come nearer along the axis
/// (Mirtich 1996, "Impulse-based Dynamic Simulation", section 2.3). It never looks ahead, so that a
/// spin costs it many more steps.
template <class S>
ImpactResult<S> conservative_advancement(const MovingShape<S>& a, const MovingShape<S>& b,
                                         const ImpactLimits<S>& allowed = {},
                                         ImpactRun<S>* run = nullptr);
template <class S>
ImpactResult<S> conservative_advancement(const MovingPlane<S>& a, const MovingShape<S>& b,
                                         const ImpactLimits<S>& allowed = {},
                                         ImpactRun<S>* run = nullptr);

}  // namespace contactscope
