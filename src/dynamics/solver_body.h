#pragma once

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
};

/// Gregorius 2015, "Recap: Solving Contact (3)": an impulse (newton seconds, world) that acts at
/// `arm` from the centre of mass. Infinite masses feel nothing.
template <class S>
void apply_impulse(SolverBody<S>& body, const Vec3<S>& impulse, const Vec3<S>& arm) {
  body.body.velocity += body.body.inverse_mass * impulse;
  const Vec3<S> torque = arm.cross(impulse);
  body.body.angular_velocity += body.inverse_inertia_world * torque;
}

/// Gregorius 2015, "Recap: Solving Contact (2)": v2 + w2 x r2 - v1 - w1 x r1, metres a second. Along
/// the normal from a to b, negative closes the contact and positive opens it.
template <class S>
Vec3<S> relative_velocity(const SolverBody<S>& a, const SolverBody<S>& b, const Vec3<S>& arm_a,
                          const Vec3<S>& arm_b) {
  const Vec3<S> of_a = a.body.velocity + a.body.angular_velocity.cross(arm_a);
  const Vec3<S> of_b = b.body.velocity + b.body.angular_velocity.cross(arm_b);
  return of_b - of_a;
}

/// How much relative velocity along the unit vector `direction` one newton second makes there, 1/kg.
template <class S>
S inverse_effective_mass(const SolverBody<S>& a, const SolverBody<S>& b, const Vec3<S>& arm_a,
                         const Vec3<S>& arm_b, const Vec3<S>& direction) {
  const Vec3<S> lever_a = arm_a.cross(direction);
  const Vec3<S> lever_b = arm_b.cross(direction);
  const Vec3<S> turned_a = a.inverse_inertia_world * lever_a;
  const Vec3<S> turned_b = b.inverse_inertia_world * lever_b;
  return (a.body.inverse_mass + b.body.inverse_mass) +
         (lever_a.dot(turned_a) + lever_b.dot(turned_b));
}

}  // namespace contactscope
