#pragma once

#include <vector>

#include "core/feature_id.h"
#include "dynamics/solver_body.h"

namespace contactscope {

/// What the solver keeps of one contact point during a step. Impulses are newton seconds on b; a has
/// the opposite.
template <class S>
struct ConstraintPoint {
  // From the centres of mass to the point when the step began, world. Impulses act there for the
  // whole step (Catto 2024, "Solver2D": arms of the Jacobian are fixed): two arms that met in one
  // point keep angular momentum, arms that drift apart do not.
  Vec3<S> arm_a, arm_b;
  Vec3<S> anchor_a, anchor_b;  // the same places in the bodies' own axes, from the centres of mass
  S separation_began = 0;      // metres along the normal, when the step began
  S separation = 0;            // where the bodies are now; see update_separations
  S normal_mass = 0;           // kg
  S tangent_mass = 0;          // kg, along the tangent that yields most
  S approach = 0;              // relative velocity along the normal that restitution goes by, m/s

  S normal_impulse = 0;  // of this sub-step, never negative
  S friction_u = 0;      // along the tangents
  S friction_v = 0;
  S position_impulse = 0;  // kg m, of the projection of this sub-step

  S warm_start = 0;    // along the normal, over the whole step, if nothing had changed
  S total_normal = 0;  // over the whole step
  S total_u = 0;
  S total_v = 0;

  int triangle = -1;  // of a mesh
  FeatureId id;
};

/// The points of one manifold.
template <class S>
struct ContactConstraint {
  int a = 0, b = 0;                                                    // bodies
  int pair = 0;                                                        // whose manifold it is
  Vec3<S> normal = Vec3<S>::UnitY();                                   // unit, from a to b
  Vec3<S> tangent_u = Vec3<S>::UnitX(), tangent_v = Vec3<S>::UnitZ();  // unit, at right angles
  S friction = 0;
  S restitution = 0;
  std::vector<ConstraintPoint<S>> points;
};

}  // namespace contactscope
