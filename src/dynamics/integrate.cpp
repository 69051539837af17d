#include "dynamics/integrate.h"

#include <cmath>
#include <limits>

namespace contactscope {
namespace {

template <class S>
Mat3<S> cross_matrix(const Vec3<S>& v) {
  Mat3<S> m;
  m << S(0), -v.z(), v.y(), v.z(), S(0), -v.x(), -v.y(), v.x(), S(0);
  return m;
}

/// Angular velocity at the midpoint of a free turn, body's axes.
template <class S>
struct Midpoint {
  Vec3<S> velocity;
  bool converged = false;  // false: Newton failed, and this is the velocity of the beginning
};

template <class S>
Midpoint<S> midpoint_velocity(const Body<S>& body, const Vec3<S>& w, S h) {
  constexpr int kMostIterations = 8;  // two or three at a radian a step
  const Vec3<S> momentum = body.inertia * w;
  // What rounding leaves of the residual: a few units in the last place of the momentum.
  const S enough = S(8) * std::numeric_limits<S>::epsilon() * momentum.norm();
  Vec3<S> m = w;
  for (int i = 0; i < kMostIterations; ++i) {
    const Vec3<S> at_m = body.inertia * m;
    const Vec3<S> residual = at_m - momentum - S(0.5) * h * at_m.cross(m);
    if (residual.norm() <= enough) return {m, true};
    const Mat3<S> turned = cross_matrix(m) * body.inertia;
    const Mat3<S> jacobian = body.inertia + S(0.5) * h * (turned - cross_matrix(at_m));
    const Mat3<S> inverse = jacobian.inverse();
    const Vec3<S> step = inverse * residual;
    m -= step;
    if (!m.allFinite()) return {w, false};
  }
  const Vec3<S> at_m = body.inertia * m;
  const Vec3<S> residual = at_m - momentum - S(0.5) * h * at_m.cross(m);
  // A residual that rounding keeps alive is good enough; one that is not small is no solution.
  const bool small =
      residual.norm() <= std::sqrt(std::numeric_limits<S>::epsilon()) * momentum.norm();
  return {small ? m : w, small};
}

template <class S>
void turn(Quat<S>& rotation, const Vec3<S>& half_turn) {
  rotation = Quat<S>(S(1), half_turn.x(), half_turn.y(), half_turn.z()) * rotation;
  rotation.normalize();
}

}  // namespace

template <class S>
void integrate_velocity(SolverBody<S>& body, const Vec3<S>& gravity, S h) {
  if (body.body.dynamic()) body.body.velocity += h * gravity;
}

template <class S>
void integrate_position(SolverBody<S>& moving, S h) {
  Body<S>& body = moving.body;
  moving.moved += h * body.velocity;
  if (body.angular_velocity.isZero(S(0))) return;
  if (!body.dynamic()) {
    turn(body.rotation, Vec3<S>(S(0.5) * h * body.angular_velocity));
    return;
  }
  const Vec3<S> before = body.rotation.conjugate() * body.angular_velocity;
  const Vec3<S> local_momentum = body.inertia * before;
  const Vec3<S> momentum = body.rotation * local_momentum;
  const Midpoint<S> middle = midpoint_velocity(body, before, h);
  turn(body.rotation, Vec3<S>(S(0.5) * h * (body.rotation * middle.velocity)));

  const Vec3<S> turned_momentum = body.rotation.conjugate() * momentum;
  Vec3<S> after = body.inverse_inertia * turned_momentum;
  if (!middle.converged) {
    const S energy = after.dot(turned_momentum);
    const S most = before.dot(local_momentum);
    if (energy > most) after *= std::sqrt(most / energy);
  }
  body.angular_velocity = body.rotation * after;
  moving.turn_inertia();
}

#define CONTACTSCOPE_INSTANTIATE(S)                                    \
  template void integrate_velocity(SolverBody<S>&, const Vec3<S>&, S); \
  template void integrate_position(SolverBody<S>&, S);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
