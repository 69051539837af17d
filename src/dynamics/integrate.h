#pragma once

#include "dynamics/constraint.h"

/// Semi-implicit Euler: first the velocities, then the positions with the new velocities.
///
/// The gyroscopic term is part of the rotation: between impulses a body turns freely, with constant
/// angular momentum in the world. Source: implicit midpoint rule for the free rigid body (Austin,
/// Krishnaprasad and Wang 1993, "Almost Poisson Integration of Rigid Body Systems"). Catto (GDC
/// 2015, "Numerical Methods", gyroscopic torques) takes one Newton step of backward Euler instead.
/// It never blows up but damps a tumbling body; the midpoint costs the same solve and keeps both
/// momentum and energy, up to rounding.
///
/// Steps, in the body's axes, with P = I w and h the step:
///   1. the midpoint velocity m: I m - P - h/2 (I m) x m = 0, by Newton from w;
///   2. turn by Cayley's rotation of h m, the unit quaternion along (1, h/2 m);
///   3. the momentum in the world stays, so w' is that momentum through the turned inertia.
namespace contactscope {

template <class S> Mat3<S> cross_matrix(const Vec3<S>& v) {
  Mat3<S> m;
  m << S(0), -v.z(), v.y(), v.z(), S(0), -v.x(), -v.y(), v.x(), S(0);
  return m;
}

/// Angular velocity at the midpoint of a free rotation, body's axes.
template <class S> struct Midpoint {
  Vec3<S> velocity;
  bool converged = false;  // false: this is Newton's best iterate
};

template <class S> Midpoint<S> midpoint_velocity(const Body<S>& body, const Vec3<S>& w, S h) {
  constexpr int kMaxIterations = 10;  // three or four at a radian per step
  const Vec3<S> momentum = body.inertia * w;
  Midpoint<S> best{w};
  S least = std::numeric_limits<S>::infinity();
  // Newton continues until rounding stops it: the error left by a tolerance would have the same
  // sign in every step, and add up.
  Vec3<S> m = w;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Vec3<S> at_m = body.inertia * m;
    const Vec3<S> residual = at_m - momentum - S(0.5) * h * at_m.cross(m);
    const S size = residual.norm();
    if (!(size < least)) break;
    least = size;
    best.velocity = m;
    if (size == 0) break;
    const Mat3<S> turned = cross_matrix(m) * body.inertia;
    const Mat3<S> jacobian = body.inertia + S(0.5) * h * (turned - cross_matrix(at_m));
    const Mat3<S> inverse = jacobian.inverse();
    const Vec3<S> step = inverse * residual;
    m -= step;
  }
  // A few units in the last place of the momentum.
  best.converged = least <= S(16) * std::numeric_limits<S>::epsilon() * momentum.norm();
  return best;
}

/// Moves and turns a body by its velocities for `h` seconds. Turns a dynamic body's angular
/// velocity by its gyroscopic term. Spins that the step cannot resolve (Newton fails at several
/// radians per step) keep their momentum, scaled down if that adds energy.
template <class S> void integrate_position(SolverBody<S>& moving, S h) {
  Body<S>& body = moving.body;
  moving.moved += h * body.velocity;
  if (body.angular_velocity.isZero(S(0))) return;
  if (!body.dynamic()) {
    moving.turn(Vec3<S>(S(0.5) * h * body.angular_velocity));
    return;
  }
  const Vec3<S> before = body.rotation.conjugate() * body.angular_velocity;
  const Vec3<S> local_momentum = body.inertia * before;
  const Vec3<S> momentum = body.rotation * local_momentum;
  const Midpoint<S> middle = midpoint_velocity(body, before, h);
  moving.turn(Vec3<S>(S(0.5) * h * (body.rotation * middle.velocity)));

  const Vec3<S> turned_momentum = body.rotation.conjugate() * momentum;
  Vec3<S> after = body.inverse_inertia * turned_momentum;
  // The rounded inverse has the same small error in every step. This stops a drift of momentum.
  const Vec3<S> lacking = turned_momentum - body.inertia * after;
  after += body.inverse_inertia * lacking;
  if (!middle.converged) {
    const S energy = after.dot(turned_momentum);
    const S most = before.dot(local_momentum);
    if (energy > most) after *= std::sqrt(most / energy);
  }
  body.angular_velocity = body.rotation * after;
  moving.turn_inertia();
}

}  // namespace contactscope
