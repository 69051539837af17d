#pragma once

#include "continuous/motion_bounds.h"
#include "query/support_set.h"

namespace contactscope {

enum class ImpactStatus {
  Separated,    // at all times of the step farther than the tolerance
  Hit,          // within the tolerance at `time`, and never before
  Overlapping,  // at time 0, or closer than rounding then
  /// kMaxImpactSteps reached, or rounding of a large motion: separated until `time`, unknown after.
  OutOfIterations,
};

constexpr const char* to_string(ImpactStatus status) {
  constexpr const char* kNames[] = {"separated", "hit", "overlapping", "out_of_iterations"};
  return kNames[static_cast<int>(status)];
}

/// A convex shape that moves: its core, and the distance of its surface from the core.
template <class S> struct MovingShape {
  SupportSet<S> core;
  Sweep<S> motion;
  S radius = 0;  // metres, for spheres and capsules
};

/// A moving half-space, everything below a plane.
template <class S> struct MovingPlane {
  Plane<S> plane;  // in the shape's frame
  Sweep<S> motion;
};

template <class S> struct ImpactResult {
  ImpactStatus status = ImpactStatus::OutOfIterations;
  S time = 0;  // fraction of the step; ImpactLimits::until when Separated
  /// Distance between the surfaces at `time`, metres. If not a Hit, the last measured one, or 0.
  S distance = 0;
  /// Unit, from A to B, world, at `time` of a Hit; the last one seen when out of iterations.
  Vec3<S> normal = Vec3<S>::UnitX();
  Vec3<S> on_a = Vec3<S>::Zero();  // closest surface points of a Hit at `time`, world
  Vec3<S> on_b = Vec3<S>::Zero();
  int steps = 0;   // distances measured, including the one that ends a cast
  int bounds = 0;  // projections on an axis, including support points of casts
};

/// One step of the search, recorded for pictures.
template <class S> struct ImpactStep {
  S time;        // of the distance
  S distance;    // between the surfaces, metres
  Vec3<S> axis;  // unit, from A to B, world; separates the shapes
  /// Time and value of the last separation measured along the axis. Conservative advancement, and
  /// shapes that do not turn, extrapolate the fastest approach instead: to the time when the
  /// distance is used up, or to the end of the step or of the time in which bounding balls are
  /// near. A cast records each support plane that increases the safe time: that time, the rest.
  S bracket_end;
  S bracket_separation;
  S safe;  // no impact until then
};

template <class S> struct ImpactRun {
  ImpactResult<S> result;
  std::vector<ImpactStep<S>> steps;
};

/// A tenth is enough, except for shapes that glide past each other at about the tolerance, and for
/// conservative advancement of shapes that spin many times.
inline constexpr int kMaxImpactSteps = 256;

/// Tolerance of a hit: the larger of gap and of_motion, at least 32 roundings of the extent.
template <class S> struct ImpactLimits {
  S gap = 0;  // metres
  /// Fraction of the largest displacement of a point relative to the other shape in the step. A
  /// head-on impact is reported early by at most this fraction of the step.
  S of_motion = S(1e-5);
  S until = 1;  // fraction of the step, > 0
  /// Skips mesh triangles that overlap at the start, and reports later impacts with other
  /// triangles. For callers that already have contacts with the skipped ones.
  bool passes_overlaps = false;
};

/// The first time in a step at which two convex shapes are within the tolerance of each other.
/// Shapes that start nearer than that hit when their distance falls to three quarters.
///
/// Never late: the shapes are separated at every time before `time`, for rotations of any size.
/// Early only by the tolerance: the surfaces are within it at `time`. Motions are subtracted first,
/// so shapes far from the origin lose no more precision than their coordinates have lost.
///
/// Bounding balls give the time at which the search starts. Polyhedra are cast against each other
/// from there (foresee_impact()). The search then finds the root of the separation along GJK's
/// axis: exactly if nothing turns, else by a bound between now and where the nearest points would
/// meet. Round shapes skip the cast. `run`: null: not recorded.
template <class S>
ImpactResult<S> time_of_impact(const MovingShape<S>& a, const MovingShape<S>& b,
                               const ImpactLimits<S>& allowed = {}, ImpactRun<S>* run = nullptr);
template <class S>
ImpactResult<S> time_of_impact(const MovingPlane<S>& a, const MovingShape<S>& b,
                               const ImpactLimits<S>& allowed = {}, ImpactRun<S>* run = nullptr);

/// Conservative advancement: advances by the distance over the fastest possible approach of any two
/// points along the axis (Mirtich 1996, "Impulse-based Dynamic Simulation", section 2.3). It never
/// looks ahead, so spinning shapes need many more steps.
template <class S>
ImpactResult<S> conservative_advancement(const MovingShape<S>& a, const MovingShape<S>& b,
                                         const ImpactLimits<S>& allowed = {},
                                         ImpactRun<S>* run = nullptr);
template <class S>
ImpactResult<S> conservative_advancement(const MovingPlane<S>& a, const MovingShape<S>& b,
                                         const ImpactLimits<S>& allowed = {},
                                         ImpactRun<S>* run = nullptr);

}  // namespace contactscope
