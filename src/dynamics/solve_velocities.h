#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "dynamics/constraint.h"

/// Sequential impulses: each contact point by itself, in turn, over and over. Source: Catto 2006,
/// "Fast and Simple Physics using Sequential Impulses"; Gregorius 2015, "Recap: Solving Contact".
///
/// Friction is Coulomb's cone: a vector in the contact plane, no longer than the coefficient times
/// the normal impulse of the sweep before (Catto clamps two tangents, each by itself: a pyramid, whose
/// friction depends on where the tangents happen to lie).
namespace contactscope {

/// The velocity that a contact point is driven to, by how far it is apart or overlaps.
///
/// The relative velocity along the normal is driven to -(velocity), with `mass_scale` of the mass
/// and forgetting `impulse_scale` of the impulse so far: impulse = -mass mass_scale (v + velocity) -
/// impulse_scale impulse.
template <class S>
struct PositionBias {
  S velocity = 0;  // metres a second
  S mass_scale = 1;
  S impulse_scale = 0;
};

/// Gregorius 2015, "Recap: Solving Contact (4)": v_rel = -0.1 / dt * d. Overlap up to the slop is let
/// be, else contacts would come and go.
///
/// Warm starting makes the push late, and a late spring pumps. Of one slow motion of a stack let p be
/// the overlap, y its change in a frame, and e' = g e - (1 - g)(y + b p) what the impulses lack after
/// the sweeps of a frame, which leave the share g of an error: y' = y + e', p' = p + y'. The
/// characteristic polynomial (z^2 - 2 g z + g)(z - 1) + (1 - g) b z^2 has its roots within the unit
/// circle while 1 - g > b / (1 + b) (Jury): 9 % for 0.1.
///
/// The slowest motion is a sway of the whole stack, and each box more slows it down. Measured on equal
/// cubes that begin touching, at default settings: four come to rest (1e-13 J after ten seconds), six
/// sway for twenty seconds, ten fall within twenty. With four sub-steps eight come to rest; ten sway
/// for ever with a hundred sweeps, and come to rest with three hundred.
template <class S>
PositionBias<S> baumgarte(S separation, const SolverSettings& settings, S h) {
  const S overlap = std::min(separation + static_cast<S>(settings.slop.value_or(0)), S(0));
  return {static_cast<S>(settings.baumgarte) / h * overlap, S(1), S(0)};
}

/// Catto 2024, "Solver2D", soft step: a damped spring of `hertz` and `damping_ratio`, which the step
/// can resolve: at most a quarter of the sub-steps' rate. Against a body of infinite mass twice as
/// stiff (ibid.), so that stacks sink less into their ground than into each other. The velocity with
/// which overlaps are pushed out has no upper limit here: it is taken back when the contact relaxes.
template <class S>
PositionBias<S> soft(S separation, const SolverSettings& settings, bool against_static, S h) {
  const S hertz = std::min(static_cast<S>(settings.hertz), S(0.25) / h) * (against_static ? 2 : 1);
  const S omega = S(2) * std::numbers::pi_v<S> * hertz;
  const S a1 = S(2) * static_cast<S>(settings.damping_ratio) + h * omega;
  const S a2 = h * omega * a1;
  const S a3 = S(1) / (S(1) + a2);
  const S overlap = std::min(separation + static_cast<S>(settings.slop.value_or(0)), S(0));
  return {omega / a1 * overlap, a2 * a3, a3};
}

/// Of a point at `separation` in a sub-step of `h` seconds. Off, overlap is let be. `settings` are
/// settled().
template <class S>
PositionBias<S> position_bias(S separation, bool on, bool against_static,
                              const SolverSettings& settings, S h) {
  // Points that are apart may close, but not by more than what there is between them (Catto 2013,
  // "Continuous Collision", speculative contacts).
  if (separation > 0) return {separation / h, S(1), S(0)};
  if (!on || settings.position_correction == PositionCorrection::Projection) return {};
  if (settings.position_correction == PositionCorrection::Baumgarte)
    return baumgarte(separation, settings, h);
  return soft(separation, settings, against_static, h);
}

/// Impulses that the points begin with.
template <class S>
void warm_start(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts) {
  for_each_point(bodies, contacts, [](const auto& pair, const auto& contact, const auto& point) {
    pair.push(point,
              Vec3<S>(point.normal_impulse * contact.normal + point.friction_u * contact.tangent_u +
                      point.friction_v * contact.tangent_v));
  });
}

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

/// One sweep over all contacts: of each its friction, then its normal impulses, which matter more
/// and so have the last word. `push`: overlaps are worked off as the settings say; false: they are
/// let be (relaxation). `h` is the sub-step in seconds.
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

// Bodies at rest meet with what gravity adds in one sub-step, and must not bounce from that; as much
// again for what the sweeps leave over.
inline constexpr double kRestitutionThreshold = 2;  // times gravity times the sub-step

/// How fast the bodies would meet where they are now, see apply_restitution; `closing` in metres a
/// second, a second.
template <class S>
S met_velocity(const ConstraintPoint<S>& point, S closing, S h) {
  const S half_step = S(0.5) * closing * h;
  const S began = -point.approach - half_step;
  const S lift = point.separation - point.separation_began;
  return std::sqrt(std::max(began * began - 2 * closing * lift, S(0))) + half_step;
}

/// One sweep over points that were hit faster than bodies at rest are, and pushed back: they leave
/// with their share of the velocity that they would have met with where they are now.
///
/// A step meets late, deep inside, or by a speculative point early; and then it lifts what overlaps.
/// With the share of the approaching velocity itself the bodies would keep that lift as height: each
/// bounce of an elastic ball would end higher. So let u close a contact, c be the acceleration that
/// closes it and l the way that the step has opened it by: sqrt(u^2 - 2 c l) is what free motion
/// would leave of u there. Semi-implicit Euler moves along a parabola whose velocity at the ends of
/// a sub-step is c h / 2 beside the one that it holds, and that much is taken off before and added
/// after: an elastic bounce keeps the energy of a ball, whatever worked its overlap off.
///
/// `gravity` in metres a second, a second, `h` the sub-step in seconds; separations are up to date.
template <class S>
void apply_restitution(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                       const Vec3<S>& gravity, S h) {
  const S threshold = static_cast<S>(kRestitutionThreshold) * gravity.norm() * h;
  for_each_point(bodies, contacts, [&](const auto& pair, const auto& contact, auto& point) {
    if (contact.restitution == 0 || !(point.approach < -threshold) || point.total_normal == 0)
      return;
    const S closing =
        (static_cast<S>(pair.a.body.dynamic()) - static_cast<S>(pair.b.body.dynamic())) *
        gravity.dot(contact.normal);
    const S velocity = pair.velocity_at(point).dot(contact.normal);
    const S target = contact.restitution * met_velocity(point, closing, h);
    const S change = point.normal_mass * (target - velocity);
    const S total = std::max(point.total_normal + change, S(0));
    pair.push(point, Vec3<S>((total - point.total_normal) * contact.normal));
    point.total_normal = total;
  });
}

}  // namespace contactscope
