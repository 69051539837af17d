#pragma once

#include "dynamics/solver_body.h"

/// Semi-implicit Euler: first the velocities, then the positions with the new velocities.
///
/// The gyroscopic term belongs to the turning: between impulses a body turns freely, its angular
/// momentum constant in the world. Source: implicit midpoint rule for the free rigid body (Austin,
/// Krishnaprasad and Wang 1993, "Almost Poisson Integration of Rigid Body Systems"). Catto (GDC
/// 2015, "Numerical Methods", gyroscopic torques) takes one Newton step of backward Euler instead,
/// which never blows up but damps a tumbling body; the midpoint costs the same solve and keeps both
/// momentum and energy, up to rounding.
///
/// Steps, in the body's axes, with P = I w and h the step:
///   1. the midpoint velocity m: I m - P - h/2 (I m) x m = 0, by Newton from w;
///   2. turn by Cayley's rotation of h m, the unit quaternion along (1, h/2 m);
///   3. the momentum of the world stays, so w' is that momentum through the turned inertia.
namespace contactscope {

/// Gravity (metres a second, a second) for `h` seconds. Bodies of infinite mass keep their script.
template <class S>
void integrate_velocity(SolverBody<S>& body, const Vec3<S>& gravity, S h);

/// Moves and turns by the velocities for `h` seconds; turns the angular velocity of a dynamic body
/// as its gyroscopic term demands. Spins beyond what the step can resolve (Newton fails at several
/// radians a step) keep their momentum as far as that does not add energy.
template <class S>
void integrate_position(SolverBody<S>& body, S h);

}  // namespace contactscope
