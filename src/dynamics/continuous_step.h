#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "continuous/impact_of_shapes.h"
#include "dynamics/body.h"
#include "dynamics/solver_settings.h"

/// Bodies that the solver has moved are stopped where they first meet between two frames, and go on
/// from there with what the contact leaves them of their velocities: sub-steps by pair (Catto 2013,
/// "Continuous Collision").
namespace contactscope {

/// How a body goes on as it moves now, for `dt` seconds.
template <class S>
Sweep<S> sweep_of(const Body<S>& body, S dt) {
  return {body.pose(), body.local_center, dt * body.velocity, dt * body.angular_velocity};
}

/// What two bodies are to each other, where they are stopped between frames.
template <class S>
struct ContinuousPair {
  ImpactMethod method = ImpactMethod::TimeOfImpact;
  S friction = 0;
  S restitution = 0;
};

/// Where two bodies were stopped within a step.
template <class S>
struct ImpactStop {
  int a = 0, b = 0;                   // bodies, a < b
  S time = 0;                         // fraction of the step
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from a to b, world
  Vec3<S> point = Vec3<S>::Zero();    // of a's surface, world
  bool for_good = false;              // the last one that the step allows: both stay there
};

/// What is asked for impacts in place of a body's shape: moved inward, so that bodies that rest on each
/// other within the solver's slop have not met yet, and those that come fast are stopped before they
/// overlap by more than that. Static shapes stay as they are: a wall may be thinner than any slop.
/// In double, whatever the solver computes in: the slop of a small body may be no more than a few
/// roundings of a float of the wall that it meets.
struct ImpactCore {
  Shape<double> shape;
  double depth = 0;  // metres by which its surface is moved inward
};
template <class S>
std::vector<ImpactCore> impact_cores(const std::vector<Body<S>>& bodies,
                                     const std::vector<Shape<S>>& shapes,
                                     const SolverSettings& settings);

/// What stop_at_impacts() asks: nothing of two bodies that may pass through each other.
template <class S>
using ContinuousPairs = std::function<std::optional<ContinuousPair<S>>(int a, int b)>;

/// Bodies that a step has moved from where they were `before` to where they are now, in `dt` seconds
/// (> 0). Of those that meet on the way, the first are put back to where they meet; their contacts there
/// change their velocities, and they go on for what is left of the step, until no two meet. A pair
/// that has stopped eight times stays where it is for the rest of the step, so that this ends. `cores`
/// of the same shapes and settings. Returns the stops in the order of their times.
///
/// A sweep between two poses stands for what the solver's sub-steps did: straight, and turning at a
/// constant rate. What overlaps already is left to the contacts of the step.
template <class S>
std::vector<ImpactStop<S>> stop_at_impacts(std::vector<Body<S>>& bodies,
                                           const std::vector<Body<S>>& before,
                                           const std::vector<Shape<S>>& shapes,
                                           const std::vector<ImpactCore>& cores,
                                           const ContinuousPairs<S>& pair_of,
                                           const SolverSettings& settings, S dt);

}  // namespace contactscope
