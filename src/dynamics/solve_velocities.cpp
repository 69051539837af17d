#include "dynamics/solve_velocities.h"

#include <algorithm>
#include <cmath>

#include "dynamics/position_bias.h"

namespace contactscope {
namespace {

// Bodies at rest meet with what gravity adds in one sub-step, and must not bounce from that; as much
// again for what the sweeps leave over.
constexpr double kRestitutionThreshold = 2;  // times gravity times the sub-step

/// The two bodies of a contact.
template <class S>
struct BodyPair {
  SolverBody<S>& a;
  SolverBody<S>& b;

  BodyPair(std::span<SolverBody<S>> bodies, const ContactConstraint<S>& contact)
      : a(bodies[static_cast<std::size_t>(contact.a)]),
        b(bodies[static_cast<std::size_t>(contact.b)]) {}

  Vec3<S> velocity_at(const ConstraintPoint<S>& point) const {
    return relative_velocity(a, b, point.arm_a, point.arm_b);
  }
  /// Equal and opposite.
  void push(const ConstraintPoint<S>& point, const Vec3<S>& impulse) const {
    apply_impulse(a, Vec3<S>(-impulse), point.arm_a);
    apply_impulse(b, impulse, point.arm_b);
  }
};

template <class S>
void solve_friction(const BodyPair<S>& bodies, const ContactConstraint<S>& contact,
                    ConstraintPoint<S>& point) {
  const Vec3<S> velocity = bodies.velocity_at(point);
  S u = point.friction_u - point.tangent_mass * velocity.dot(contact.tangent_u);
  S v = point.friction_v - point.tangent_mass * velocity.dot(contact.tangent_v);
  const S most = contact.friction * point.normal_impulse;
  const S length = std::sqrt(u * u + v * v);
  if (length > most) {
    u *= most / length;
    v *= most / length;
  }
  const Vec3<S> impulse =
      (u - point.friction_u) * contact.tangent_u + (v - point.friction_v) * contact.tangent_v;
  point.friction_u = u;
  point.friction_v = v;
  bodies.push(point, impulse);
}

/// How fast the bodies would meet where they are now, see apply_restitution; `closing` in metres a
/// second, a second.
template <class S>
S met_velocity(const ConstraintPoint<S>& point, S closing, S h) {
  const S half_step = S(0.5) * closing * h;
  const S began = -point.approach - half_step;
  const S lift = point.separation - point.separation_began;
  return std::sqrt(std::max(began * began - 2 * closing * lift, S(0))) + half_step;
}

template <class S>
void solve_normal(const BodyPair<S>& bodies, const Vec3<S>& normal, const PositionBias<S>& bias,
                  ConstraintPoint<S>& point) {
  const S velocity = bodies.velocity_at(point).dot(normal);
  const S change = -point.normal_mass * bias.mass_scale * (velocity + bias.velocity) -
                   bias.impulse_scale * point.normal_impulse;
  // The sum is held at zero, not the change: a contact may take back what it gave too much.
  const S impulse = std::max(point.normal_impulse + change, S(0));
  bodies.push(point, Vec3<S>((impulse - point.normal_impulse) * normal));
  point.normal_impulse = impulse;
}

}  // namespace

template <class S>
void warm_start(std::span<SolverBody<S>> bodies,
                const std::vector<ContactConstraint<S>>& contacts) {
  for (const ContactConstraint<S>& contact : contacts) {
    const BodyPair<S> pair(bodies, contact);
    for (const ConstraintPoint<S>& point : contact.points)
      pair.push(point, Vec3<S>(point.normal_impulse * contact.normal +
                               point.friction_u * contact.tangent_u +
                               point.friction_v * contact.tangent_v));
  }
}

template <class S>
void solve_velocities(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                      const SolverSettings& settings, bool push, S h) {
  for (ContactConstraint<S>& contact : contacts) {
    const BodyPair<S> pair(bodies, contact);
    const bool against_static = !(pair.a.body.dynamic() && pair.b.body.dynamic());
    for (ConstraintPoint<S>& point : contact.points) solve_friction(pair, contact, point);
    for (ConstraintPoint<S>& point : contact.points)
      solve_normal(pair, contact.normal,
                   position_bias(point.separation, push, against_static, settings, h), point);
  }
}

template <class S>
void note_approach(std::span<const SolverBody<S>> bodies,
                   std::vector<ContactConstraint<S>>& contacts) {
  for (ContactConstraint<S>& contact : contacts) {
    const SolverBody<S>& a = bodies[static_cast<std::size_t>(contact.a)];
    const SolverBody<S>& b = bodies[static_cast<std::size_t>(contact.b)];
    for (ConstraintPoint<S>& point : contact.points)
      point.approach = relative_velocity(a, b, point.arm_a, point.arm_b).dot(contact.normal);
  }
}

template <class S>
void apply_restitution(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                       const Vec3<S>& gravity, S h) {
  const S threshold = static_cast<S>(kRestitutionThreshold) * gravity.norm() * h;
  for (ContactConstraint<S>& contact : contacts) {
    if (contact.restitution == 0) continue;
    const BodyPair<S> pair(bodies, contact);
    const S closing =
        (static_cast<S>(pair.a.body.dynamic()) - static_cast<S>(pair.b.body.dynamic())) *
        gravity.dot(contact.normal);
    for (ConstraintPoint<S>& point : contact.points) {
      if (!(point.approach < -threshold) || point.total_normal == 0) continue;
      const S velocity = pair.velocity_at(point).dot(contact.normal);
      const S target = contact.restitution * met_velocity(point, closing, h);
      const S change = point.normal_mass * (target - velocity);
      const S total = std::max(point.total_normal + change, S(0));
      pair.push(point, Vec3<S>((total - point.total_normal) * contact.normal));
      point.total_normal = total;
    }
  }
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                                \
  template void warm_start(std::span<SolverBody<S>>, const std::vector<ContactConstraint<S>>&);    \
  template void solve_velocities(std::span<SolverBody<S>>, std::vector<ContactConstraint<S>>&,     \
                                 const SolverSettings&, bool, S);                                  \
  template void note_approach(std::span<const SolverBody<S>>, std::vector<ContactConstraint<S>>&); \
  template void apply_restitution(std::span<SolverBody<S>>, std::vector<ContactConstraint<S>>&,    \
                                  const Vec3<S>&, S);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
