#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "dynamics/constraint.h"
#include "dynamics/solve_velocities.h"

namespace contactscope {

// Sweeps over the points of one manifold before its bodies move. They reduce the differences
// between the corners of a box to a hundredth.
inline constexpr int kManifoldSweeps = 8;
// Largest turn of a body by one manifold in one sweep, radians. Separations are linear in the turn
// only to first order; the error, its square, is left for the next sweep.
inline constexpr double kMaxTurn = 0.1;

/// Relative displacement of a manifold's bodies.
template <class S>
struct Displacement {
  S gap = 0;  // of the centres along the normal, metres
  Vec3<S> turn_a = Vec3<S>::Zero(), turn_b = Vec3<S>::Zero();  // radians, world
};

/// One point at the bodies' current poses.
template <class S>
struct ProjectedPoint {
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
/// Each sweep is a nonlinear Gauss-Seidel step (Catto 2006, "Nonlinear position correction"),
/// manifold by manifold. Steps for each:
///   1. compute its points and their effective masses at the current poses;
///   2. find pushes that give each point its target, by sweeps over the points that treat their
///      effect on each other as linear. A point's summed push is held at zero or above, so an
///      earlier point can give back its share when a later one lifts the body too;
///   3. move and turn the bodies once, by the sum over all points, by at most a tenth of a radian.
/// Catto moves the bodies point by point, by at most 20 cm. But rotations do not commute: each
/// corner of a box deep in a floor turns it, and though the turns add up to zero, they leave it
/// turned about the vertical. One turn per manifold keeps symmetry, and a limit of the turn needs
/// no length.
template <class S>
void project_positions(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                       int iterations) {
  std::vector<ProjectedPoint<S>> points;
  for (int i = 0; i < iterations; ++i)
    for (ContactConstraint<S>& contact : contacts)
      project_manifold(BodyPair<S>(bodies, contact), contact, points);
}

/// Reduces overlaps as `settings` say, after the velocities have moved the bodies for a sub-step of
/// `h` seconds. Projection leaves each point the slop. Baumgarte moves the bodies by the part of
/// its share above the push speed, without momentum (Catto 2006, "Split Impulses"). All points that
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
  if (settings.position_correction != PositionCorrection::Baumgarte) return;
  bool wants_more = false;
  for_each_point(bodies, contacts, [&](const auto& pair, const auto& contact, auto& point) {
    const S share = -baumgarte(point.separation, settings, h);
    const bool held_back = share > static_cast<S>(settings.push_speed);
    point.position_target = held_back ? point.separation + h * share
                                      : std::min(separation_now(pair, contact, point), -slop);
    wants_more = wants_more || held_back;
  });
  if (wants_more) project_positions(bodies, contacts, settings.iterations);
}

}  // namespace contactscope
