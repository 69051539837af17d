#pragma once

#include "dynamics/constraint.h"

/// Semi-implicit Euler: first the velocities, then the positions with the new velocities.
///
/// The gyroscopic term is part of the rotation: between impulses a body turns freely, with constant
/// angular momentum in the world. Source: implicit midpoint rule for the free rigid body (Austin,
/// Krishnaprasad and Wang 1993, "Almost Poisson Integration of Rigid Body Systems"). Catto's Newton
/// step of backward Euler (GDC 2015, "Numerical Methods") damps a tumbling body; the midpoint costs
/// the same and keeps momentum and energy, up to rounding.
///
/// Steps, in the body's axes, with P = I w and h the step:
///   1. the midpoint velocity m: I m - P - h/2 (I m) x m = 0, by Newton from w;
///   2. turn by Cayley's rotation of h m, the unit quaternion along (1, h/2 m);
///   3. the momentum in the world stays, so w' is that momentum through the turned inertia.
namespace contactscope {

inline Mat3<double> cross_matrix(const Vec3d& v) {
  Mat3<double> m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Angular velocity at the midpoint of a free rotation, body's axes.
struct Midpoint {
  Vec3d velocity;
  bool converged = false;  // false: this is Newton's best iterate
};

inline Midpoint midpoint_velocity(const Mat3<double>& inertia, const Vec3d& w, double h) {
  constexpr int kMaxIterations = 10;  // three or four at a radian per step
  const Vec3d momentum = inertia * w;
  Midpoint best{w};
  double least = std::numeric_limits<double>::infinity();
  // Newton continues to rounding: a tolerance's error would have the same sign in every step.
  Vec3d m = w;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Vec3d at_m = inertia * m;
    const Vec3d residual = at_m - momentum - 0.5 * h * at_m.cross(m);
    const double size = residual.norm();
    if (!(size < least)) break;
    least = size;
    best.velocity = m;
    if (size == 0) break;
    const Mat3<double> turned = cross_matrix(m) * inertia;
    const Mat3<double> jacobian = inertia + 0.5 * h * (turned - cross_matrix(at_m));
    const Mat3<double> inverse = jacobian.inverse();
    const Vec3d step = inverse * residual;
    m -= step;
  }
  // A few units in the last place of the momentum.
  best.converged = least <= 16 * std::numeric_limits<double>::epsilon() * momentum.norm();
  return best;
}

/// Moves and turns a body by its velocities for `h` seconds. Turns a dynamic body's angular
/// velocity by its gyroscopic term. Spins that the step cannot resolve (Newton fails at several
/// radians per step) keep their momentum, scaled down if that adds energy.
///
/// Turns in double: a rotation in float is not quite a unit quaternion, in every sub-step in the
/// same direction, and a free body would gain a thousandth of its spin in a few seconds.
template <class S> void integrate_position(SolverBody<S>& moving, S h) {
  Body<S>& body = moving.body;
  moving.moved += h * body.velocity;
  if (body.angular_velocity.isZero(S(0))) return;
  if (!body.dynamic()) {
    moving.turn(Vec3<S>(S(0.5) * h * body.angular_velocity));
    return;
  }
  Quatd began = body.rotation.template cast<double>();
  if (std::is_same_v<S, float>) began.normalize();
  const Mat3<double> inertia = body.inertia.template cast<double>();
  const Mat3<double> inverse = body.inverse_inertia.template cast<double>();
  const double step = static_cast<double>(h);
  const Vec3d before = began.conjugate() * body.angular_velocity.template cast<double>();
  const Vec3d local_momentum = inertia * before;
  const Midpoint middle = midpoint_velocity(inertia, before, step);
  const Vec3d half_turn = 0.5 * step * (began * middle.velocity);
  Quatd ended = Quatd(1, half_turn.x(), half_turn.y(), half_turn.z()) * began;
  ended.normalize();

  const Vec3d turned_momentum = ended.conjugate() * (began * local_momentum);
  Vec3d after = inverse * turned_momentum;
  // The rounded inverse has the same small error in every step. This stops a drift of momentum.
  const Vec3d lacking = turned_momentum - inertia * after;
  after += inverse * lacking;
  if (!middle.converged) {
    const double energy = after.dot(turned_momentum);
    const double most = before.dot(local_momentum);
    if (energy > most) after *= std::sqrt(most / energy);
  }
  const Vec3d turned = ended * after;
  body.rotation = ended.template cast<S>();
  body.angular_velocity = turned.template cast<S>();
  moving.turn_inertia();
}

}  // namespace contactscope
