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
  bool converged = false;  // false: this is the best that Newton came by
};

template <class S>
Midpoint<S> midpoint_velocity(const Body<S>& body, const Vec3<S>& w, S h) {
  constexpr int kMostIterations = 10;  // three or four at a radian a step
  const Vec3<S> momentum = body.inertia * w;
  Midpoint<S> best{w};
  S least = std::numeric_limits<S>::infinity();
  // Until rounding stops it: what a tolerance would leave has a sign, and would add up.
  Vec3<S> m = w;
  for (int i = 0; i < kMostIterations; ++i) {
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
  // The rounded inverse is off by the same trifle in every step; so corrected, momentum does not
  // drift.
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

#define CONTACTSCOPE_INSTANTIATE(S)                                    \
  template void integrate_velocity(SolverBody<S>&, const Vec3<S>&, S); \
  template void integrate_position(SolverBody<S>&, S);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
