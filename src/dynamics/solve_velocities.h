#pragma once

#include "dynamics/constraint.h"

/// Sequential impulses: solves contact points one by one, in sweeps. Source: Catto 2006, "Fast and
/// Simple Physics using Sequential Impulses"; Gregorius 2015, "Recap: Solving Contact".
///
/// Friction is Coulomb's cone: a vector in the contact plane, no longer than the coefficient times
/// the previous sweep's normal impulse. (Catto's pyramid depends on the choice of tangents.)
namespace contactscope {

/// Target velocity of a contact point, from its separation.
///
/// Drives the relative normal velocity to -(velocity) with `mass_scale` of the mass: impulse =
/// -mass mass_scale (v + velocity) - impulse_scale impulse.
template <class S> struct PositionBias {
  S velocity = 0;  // metres per second
  S mass_scale = 1;
  S impulse_scale = 0;
};

/// Gregorius 2015, "Recap: Solving Contact (4)": v_rel = -0.1 / dt * d, metres per second. Overlap
/// up to the slop is ignored, else contacts would come and go.
///
/// As a velocity that bodies keep, it has no limit: each of n sub-steps applies n times that of a
/// frame. Warm starting also delays the push, and a late spring pumps. For one slow mode of a stack
/// let p be the overlap, y its change in a frame, and e' = g e - (1 - g)(y + b p) the error of the
/// impulses after the sweeps of a frame, which leave the share g of an error. Then y' = y + e' and
/// p' = p + y'. The characteristic polynomial (z^2 - 2 g z + g)(z - 1) + (1 - g) b z^2 has its
/// roots within the unit circle while 1 - g > b / (1 + b) (Jury): 9 % for 0.1. Ten sweeps do less
/// for ten boxes, or for one under a hundred times its mass. So bodies keep at most the push speed,
/// and correct_positions() moves them by the rest.
template <class S> S baumgarte(S separation, const SolverSettings& settings, S h) {
  const S overlap = std::min(separation + static_cast<S>(settings.slop.value_or(0)), S(0));
  return static_cast<S>(settings.baumgarte) / h * overlap;
}

/// Catto 2024, "Solver2D", soft step: a damped spring of `hertz` and `damping_ratio`, limited to
/// what the step can resolve, a quarter of the sub-steps' rate. Twice as stiff against infinite
/// mass (ibid.), so that stacks sink less into their ground than into each other. What sweeps leave
/// of the push is kept, so it is at most the push speed too.
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

/// The push that Baumgarte or a soft contact wants, whatever its speed.
template <class S>
PositionBias<S> wanted_push(S separation, const SolverSettings& settings, bool against_static,
                            S h) {
  if (settings.position_correction == PositionCorrection::Soft)
    return soft(separation, settings, against_static, h);
  return {baumgarte(separation, settings, h)};
}

/// Bias of a point in a sub-step of `h` seconds. Off: overlap is ignored. `settings` are settled().
template <class S>
PositionBias<S> position_bias(const ConstraintPoint<S>& point, bool on, bool against_static,
                              const SolverSettings& settings, S h) {
  // Speculative contact (Catto 2013, "Continuous Collision"): may close up to its separation.
  if (point.separation > 0) return {point.separation / h, S(1), S(0)};
  if (!on || settings.position_correction == PositionCorrection::Projection) return {};
  PositionBias<S> bias = wanted_push(point.separation, settings, against_static, h);
  bias.velocity = std::max(bias.velocity, -static_cast<S>(settings.push_speed));
  return bias;
}

/// Applies the initial impulses of the points.
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
  // Clamp the sum, not the change: a contact may give back what was too much.
  const S impulse = std::max(point.normal_impulse + change, S(0));
  bodies.push(point, Vec3<S>((impulse - point.normal_impulse) * normal));
  point.normal_impulse = impulse;
}

/// One sweep over all contacts: for each, friction first, then the normal impulses, which matter
/// more and so come last. `push`: reduces overlaps as `settings` say. Without it: relaxation, which
/// removes that push and skips bounces and unmet points. `h`: seconds.
template <class S>
void solve_velocities(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                      const SolverSettings& settings, bool push, S h) {
  const auto solved = [&](const ConstraintPoint<S>& point) {
    return push || (point.bounce == 0 && (point.separation <= 0 || point.normal_impulse > 0));
  };
  for (ContactConstraint<S>& contact : contacts) {
    const BodyPair<S> pair(bodies, contact);
    const bool against_static = !(pair.a.body.dynamic() && pair.b.body.dynamic());
    for (ConstraintPoint<S>& point : contact.points)
      if (solved(point)) solve_friction(pair, contact, point);
    for (ConstraintPoint<S>& point : contact.points)
      if (solved(point))
        solve_normal(pair, contact.normal, position_bias(point, push, against_static, settings, h),
                     point);
  }
}

/// Relaxes soft contacts after their spring's velocity has moved the bodies: removes the rest of
/// it, which would carry them on. Removed at the arms where it was applied, else it would leave a
/// spin. Angular momentum that the bodies gain because they have moved since is removed as well.
template <class S>
void relax(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
           const SolverSettings& settings, S h) {
  update_separations(bodies, contacts);
  const auto impulse_of = [](const ContactConstraint<S>& contact) {
    Vec3<S> sum = Vec3<S>::Zero();
    for (const ConstraintPoint<S>& point : contact.points)
      sum += point.normal_impulse * contact.normal + point.friction_u * contact.tangent_u +
             point.friction_v * contact.tangent_v;
    return sum;
  };
  std::vector<Vec3<S>> before;
  for (const ContactConstraint<S>& contact : contacts) before.push_back(impulse_of(contact));
  for (int i = 0; i < settings.iterations; ++i)
    solve_velocities(bodies, contacts, settings, false, h);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const BodyPair<S> pair(bodies, contacts[i]);
    const Vec3<S> since = pair.b.moved - pair.a.moved - contacts[i].moved;
    const Vec3<S> change = impulse_of(contacts[i]) - before[i];
    take_back(pair, contacts[i], since.cross(change));
  }
}

// Sweeps over one manifold's points before its bodies move; they leave 1/100 of the differences.
inline constexpr int kManifoldSweeps = 8;
// Largest turn of a body by one manifold in one sweep, radians. Separations are linear in the turn
// only to first order; the error, its square, is left for the next sweep.
inline constexpr double kMaxTurn = 0.1;

/// Relative displacement of a manifold's bodies.
template <class S> struct Displacement {
  S gap = 0;  // of the centres along the normal, metres
  Vec3<S> turn_a = Vec3<S>::Zero(), turn_b = Vec3<S>::Zero();  // radians, world
};

/// One point at the bodies' current poses.
template <class S> struct ProjectedPoint {
  Vec3<S> lever_a, lever_b;    // arm x normal
  Vec3<S> turned_a, turned_b;  // by the inverse inertia
  S separation = 0;
  S inverse_mass = 0;  // 1/kg
  S impulse = 0;       // kg m, in addition to the sweeps before

  S separation_after(const Displacement<S>& offset) const {
    return separation + offset.gap + lever_b.dot(offset.turn_b) - lever_a.dot(offset.turn_a);
  }
};

template <class S>
ProjectedPoint<S> projected(const BodyPair<S>& bodies, const ConstraintPoint<S>& point,
                            const ContactConstraint<S>& contact) {
  const SolverBody<S>&a = bodies.a, &b = bodies.b;
  const Vec3<S>& normal = contact.normal;
  const Vec3<S> arm_a = a.body.rotation * point.anchor_a, arm_b = b.body.rotation * point.anchor_b;
  const Vec3<S> lever_a = arm_a.cross(normal), lever_b = arm_b.cross(normal);
  const Vec3<S> turned_a = a.inverse_inertia_world * lever_a;
  const Vec3<S> turned_b = b.inverse_inertia_world * lever_b;
  return {lever_a,
          lever_b,
          turned_a,
          turned_b,
          separation_now(bodies, contact, point),
          bodies.inverse_mass() + (lever_a.dot(turned_a) + lever_b.dot(turned_b))};
}

template <class S>
void project_manifold(const BodyPair<S>& bodies, ContactConstraint<S>& contact,
                      std::vector<ProjectedPoint<S>>& points) {
  points.clear();
  for (const ConstraintPoint<S>& point : contact.points)
    points.push_back(projected(bodies, point, contact));

  Displacement<S> offset;
  S sum = 0;
  bool pushed = false;
  for (int sweep = 0; sweep < kManifoldSweeps; ++sweep) {
    bool changed = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      ProjectedPoint<S>& point = points[i];
      const S error = point.separation_after(offset) - contact.points[i].position_target;
      const S least = -contact.points[i].position_impulse;
      const S impulse = std::max(point.impulse - error / point.inverse_mass, least);
      const S change = impulse - point.impulse;
      if (change == 0) continue;
      changed = true;
      point.impulse = impulse;
      sum += change;
      offset.gap += change * bodies.inverse_mass();
      offset.turn_a -= change * point.turned_a;
      offset.turn_b += change * point.turned_b;
    }
    if (!changed) break;
    pushed = true;
  }
  if (!pushed) return;
  const S turn = std::max(offset.turn_a.norm(), offset.turn_b.norm());
  const S share = turn > static_cast<S>(kMaxTurn) ? static_cast<S>(kMaxTurn) / turn : S(1);
  for (std::size_t i = 0; i < points.size(); ++i)
    contact.points[i].position_impulse += share * points[i].impulse;
  const Vec3<S> impulse = share * sum * contact.normal;
  bodies.a.displace(-bodies.a.body.inverse_mass * impulse, share * offset.turn_a);
  bodies.b.displace(bodies.b.body.inverse_mass * impulse, share * offset.turn_b);
  take_back(bodies, contact,
            impulse.cross(Vec3<S>(bodies.b.body.velocity - bodies.a.body.velocity)));
}

/// Position projection: Gregorius 2015, "Recap: Solving Contact (4)": "run a full solver sweep over
/// the contacts again, but now solving the position error directly". Pushed bodies do not fly on:
/// velocities change only to keep angular momentum.
///
/// Each sweep is nonlinear Gauss-Seidel (Catto 2006, "Nonlinear position correction"). Steps:
///   1. compute its points and their effective masses at the current poses;
///   2. find pushes that give each point its target, by sweeps over the points that treat their
///      effect on each other as linear. A point's summed push is held at zero or above, so an
///      earlier point can give back its share when a later one lifts the body too;
///   3. move and turn the bodies once, by the sum over all points, by at most a tenth of a radian.
/// Catto moves the bodies point by point, by at most 20 cm. But rotations do not commute: the turns
/// by each corner of a box deep in a floor add up to zero, and yet leave it turned about the
/// vertical. One turn per manifold keeps symmetry, and its limit needs no length.
template <class S>
void project_positions(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                       int iterations) {
  std::vector<ProjectedPoint<S>> points;
  for (int i = 0; i < iterations; ++i)
    for (ContactConstraint<S>& contact : contacts)
      project_manifold(BodyPair<S>(bodies, contact), contact, points);
}

/// Reduces overlaps as `settings` say, after the velocities have moved the bodies for a sub-step of
/// `h` seconds. Projection leaves each point the slop. The others move the bodies by the part of
/// their push above the push speed, without momentum (Catto 2006, "Split Impulses"). All points that
/// need less are held where the velocities have brought them.
template <class S>
void correct_positions(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                       const SolverSettings& settings, S h) {
  const S slop = static_cast<S>(settings.slop.value_or(0));
  if (settings.position_correction == PositionCorrection::Projection) {
    for_each_point(bodies, contacts,
                   [&](const auto&, const auto&, auto& point) { point.position_target = -slop; });
    return project_positions(bodies, contacts, settings.iterations);
  }
  bool wants_more = false;
  for_each_point(bodies, contacts, [&](const auto& pair, const auto& contact, auto& point) {
    const bool against_static = !(pair.a.body.dynamic() && pair.b.body.dynamic());
    const auto push = wanted_push(point.separation, settings, against_static, h);
    const S share = -push.mass_scale * push.velocity;
    const bool held_back = -push.velocity > static_cast<S>(settings.push_speed);
    point.position_target = held_back ? point.separation + h * share
                                      : std::min(separation_now(pair, contact, point), -slop);
    wants_more = wants_more || held_back;
  });
  if (wants_more) project_positions(bodies, contacts, settings.iterations);
}

}  // namespace contactscope
