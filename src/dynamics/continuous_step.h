#pragma once

#include "continuous/impact_of_shapes.h"
#include "dynamics/body.h"
#include "dynamics/solver_settings.h"

/// Stops bodies at their first impacts between two frames. They continue from there with the
/// velocities that the contact leaves them: sub-steps by pair (Catto 2013, "Continuous Collision").
namespace contactscope {

/// Motion of a body at its current velocities, for `dt` seconds.
template <class S> Sweep<S> sweep_of(const Body<S>& body, S dt) {
  return {body.pose(), body.local_center, dt * body.velocity, dt * body.angular_velocity};
}

/// Settings of a pair of bodies that is stopped between frames.
template <class S> struct ContinuousPair {
  ImpactMethod method = ImpactMethod::TimeOfImpact;
  S friction = 0;
  S restitution = 0;
};

/// A stop of two bodies within a step.
template <class S> struct ImpactStop {
  int a = 0, b = 0;                   // bodies, a < b
  S time = 0;                         // fraction of the step
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from a to b, world
  Vec3<S> point = Vec3<S>::Zero();    // on a's surface, world
  bool for_good = false;              // the last stop that the step allows: both stay there
};

/// Shape that replaces a body's shape in impact queries. Its surface is moved inward: bodies that
/// rest within the solver's slop have not met yet, and fast ones are stopped before they overlap by
/// more. Static shapes stay as they are: a wall may be thinner than any slop. In double for any
/// scalar of the solver: a small body's slop may be only a few float roundings of its wall.
struct ImpactCore {
  Shape<double> shape;
  double depth = 0;  // metres by which the surface is moved inward
};
template <class S>
std::vector<ImpactCore> impact_cores(const std::vector<Body<S>>& bodies,
                                     const std::vector<Shape<S>>& shapes,
                                     const SolverSettings& settings);

/// Queried by stop_at_impacts(); nullopt for two bodies that may pass through each other.
template <class S>
using ContinuousPairs = std::function<std::optional<ContinuousPair<S>>(int a, int b)>;

/// Stops bodies that a step has moved from `before` to their current poses in `dt` seconds (> 0).
/// The first two to meet are put back to where they meet. Their contacts there change their
/// velocities, and they continue for the rest of the step, until no two meet. After eight stops a
/// pair stays in place for the rest of the step, so this terminates. `cores`: from the same shapes
/// and settings. Returns the stops in the order of their times.
///
/// A sweep between two poses approximates the solver's sub-steps: straight, and turning at a
/// constant rate. Existing overlaps are left to the contacts of the step.
template <class S>
std::vector<ImpactStop<S>> stop_at_impacts(std::vector<Body<S>>& bodies,
                                           const std::vector<Body<S>>& before,
                                           const std::vector<Shape<S>>& shapes,
                                           const std::vector<ImpactCore>& cores,
                                           const ContinuousPairs<S>& pair_of,
                                           const SolverSettings& settings, S dt);

}  // namespace contactscope
