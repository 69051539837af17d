#pragma once

#include <span>
#include <vector>

#include "core/at.h"
#include "core/feature_id.h"
#include "dynamics/body.h"

namespace contactscope {

/// A body during one step of the solver. Where it is stands as how far it has come since the step
/// began: far from the origin a coordinate has no room for what a sub-step adds, the way has.
template <class S>
struct SolverBody {
  Body<S> body;                                     // `center` is that of the beginning
  Vec3<S> moved = Vec3<S>::Zero();                  // of the centre since then, metres
  Mat3<S> inverse_inertia_world = Mat3<S>::Zero();  // at the rotation of the moment

  /// Brings the world's inertia up to the rotation.
  void turn_inertia() {
    if (!body.dynamic()) return;
    const Mat3<S> axes = body.rotation.toRotationMatrix();
    const Mat3<S> half = axes * body.inverse_inertia;
    inverse_inertia_world = half * axes.transpose();
  }
  /// An impulse (newton seconds, world) that acts at `arm` from the centre of mass.
  void apply_impulse(const Vec3<S>& impulse, const Vec3<S>& arm) {
    body.velocity += body.inverse_mass * impulse;
    const Vec3<S> torque = arm.cross(impulse);
    body.angular_velocity += inverse_inertia_world * torque;
  }
  /// By Cayley's rotation of twice `half_turn` (radians, world).
  void turn(const Vec3<S>& half_turn) {
    body.rotation = Quat<S>(S(1), half_turn.x(), half_turn.y(), half_turn.z()) * body.rotation;
    body.rotation.normalize();
  }
};

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

/// The two bodies of a contact.
template <class S>
struct BodyPair {
  SolverBody<S>& a;
  SolverBody<S>& b;

  BodyPair(std::span<SolverBody<S>> bodies, int index_a, int index_b)
      : a(at(bodies, index_a)), b(at(bodies, index_b)) {}
  BodyPair(std::span<SolverBody<S>> bodies, const ContactConstraint<S>& contact)
      : BodyPair(bodies, contact.a, contact.b) {}

  S inverse_mass() const { return a.body.inverse_mass + b.body.inverse_mass; }

  /// Gregorius 2015, "Recap: Solving Contact (2)": v2 + w2 x r2 - v1 - w1 x r1, metres a second. Along
  /// the normal from a to b, negative closes the contact and positive opens it.
  Vec3<S> velocity_at(const ConstraintPoint<S>& point) const {
    const Vec3<S> of_a = a.body.velocity + a.body.angular_velocity.cross(point.arm_a);
    const Vec3<S> of_b = b.body.velocity + b.body.angular_velocity.cross(point.arm_b);
    return of_b - of_a;
  }
  /// Gregorius 2015, "Recap: Solving Contact (3)": an impulse on b (newton seconds, world), and the
  /// opposite on a. Infinite masses feel nothing.
  void push(const ConstraintPoint<S>& point, const Vec3<S>& impulse) const {
    a.apply_impulse(Vec3<S>(-impulse), point.arm_a);
    b.apply_impulse(impulse, point.arm_b);
  }
};

}  // namespace contactscope
