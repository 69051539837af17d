#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "dynamics/constraint.h"

namespace contactscope {

// Sweeps over the points of one manifold: its bodies are moved by what these come to. The corners of
// a box leave a hundredth of the difference between each other.
inline constexpr int kManifoldSweeps = 8;
// Radians that one manifold turns a body by in one sweep. What a turn does to separations is known
// to its first order alone; the square of this is left for the next sweep.
inline constexpr double kMostTurn = 0.1;

/// A way that a manifold wants its bodies to go, and what it does to a point.
template <class S>
struct Displacement {
  S apart = 0;  // metres along the normal, of both centres
  Vec3<S> turn_a = Vec3<S>::Zero(), turn_b = Vec3<S>::Zero();  // radians, world
};

/// One point where the bodies are now.
template <class S>
struct ProjectedPoint {
  Vec3<S> lever_a, lever_b;    // arm x normal
  Vec3<S> turned_a, turned_b;  // by the inverse inertia
  S separation = 0;
  S inverse_mass = 0;  // 1/kg
  S impulse = 0;       // kg m, beyond what the sweeps before gave

  S separation_after(const Displacement<S>& way) const {
    return separation + way.apart + lever_b.dot(way.turn_b) - lever_a.dot(way.turn_a);
  }
};

template <class S>
ProjectedPoint<S> projected(const BodyPair<S>& bodies, const ConstraintPoint<S>& point,
                            const Vec3<S>& normal) {
  const SolverBody<S>&a = bodies.a, &b = bodies.b;
  const Vec3<S> arm_a = a.body.rotation * point.anchor_a, arm_b = b.body.rotation * point.anchor_b;
  const Vec3<S> lever_a = arm_a.cross(normal), lever_b = arm_b.cross(normal);
  const Vec3<S> turned_a = a.inverse_inertia_world * lever_a;
  const Vec3<S> turned_b = b.inverse_inertia_world * lever_b;
  return {lever_a,
          lever_b,
          turned_a,
          turned_b,
          separation_now(bodies, point, normal),
          bodies.inverse_mass() + (lever_a.dot(turned_a) + lever_b.dot(turned_b))};
}

/// Moves a dynamic body by `way`, metres, and turns it by `turn`, radians; both world.
template <class S>
void displace(SolverBody<S>& moving, const Vec3<S>& way, const Vec3<S>& turn) {
  if (!moving.body.dynamic()) return;
  moving.moved += way;
  // Velocities stay as they are: so small a turn hardly changes the angular momentum.
  moving.turn(Vec3<S>(S(0.5) * turn));
  moving.turn_inertia();
}

template <class S>
void project_manifold(const BodyPair<S>& bodies, ContactConstraint<S>& contact, S slop,
                      std::vector<ProjectedPoint<S>>& points) {
  points.clear();
  for (const ConstraintPoint<S>& point : contact.points)
    points.push_back(projected(bodies, point, contact.normal));

  Displacement<S> way;
  S sum = 0;
  for (int sweep = 0; sweep < kManifoldSweeps; ++sweep) {
    bool changed = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      ProjectedPoint<S>& point = points[i];
      const S error = point.separation_after(way) + slop;
      const S least = -contact.points[i].position_impulse;
      const S impulse = std::max(point.impulse - error / point.inverse_mass, least);
      const S change = impulse - point.impulse;
      if (change == 0) continue;
      changed = true;
      point.impulse = impulse;
      sum += change;
      way.apart += change * bodies.inverse_mass();
      way.turn_a -= change * point.turned_a;
      way.turn_b += change * point.turned_b;
    }
    if (!changed) break;
  }
  const S turn = std::max(way.turn_a.norm(), way.turn_b.norm());
  const S share = turn > static_cast<S>(kMostTurn) ? static_cast<S>(kMostTurn) / turn : S(1);
  for (std::size_t i = 0; i < points.size(); ++i)
    contact.points[i].position_impulse += share * points[i].impulse;
  const Vec3<S> impulse = share * sum * contact.normal;
  displace(bodies.a, Vec3<S>(-bodies.a.body.inverse_mass * impulse), Vec3<S>(share * way.turn_a));
  displace(bodies.b, Vec3<S>(bodies.b.body.inverse_mass * impulse), Vec3<S>(share * way.turn_b));
}

/// Position projection: Gregorius 2015, "Recap: Solving Contact (4)": "run a full solver sweep over
/// the contacts again, but now solving the position error directly". Velocities are untouched, so
/// that nothing that is pushed out flies on.
///
/// One sweep; a nonlinear Gauss-Seidel step (Catto 2006, "Nonlinear position correction"), manifold
/// by manifold. Steps of each:
///   1. where its points are now, and their effective masses there;
///   2. pushes that leave each point an overlap of the slop, by sweeps over the points with what they
///      do to each other taken as linear. What a point has pushed so far is summed and held at zero,
///      so that a later point that lifts the body too lets an earlier one take back its share;
///   3. the bodies are moved and turned once, by what all points come to, and by no more than a tenth
///      of a radian.
/// Catto moves the bodies point by point, and never by more than 20 cm. But turns do not commute: of a
/// box deep in a floor each corner turns it, and though the turns add up to none, going through them
/// leaves it turned about the vertical. With one turn for a manifold, what is symmetric stays so, and
/// a limit of the turn has no length in it.
template <class S>
void project_positions(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                       const SolverSettings& settings) {
  const S slop = static_cast<S>(settings.slop.value_or(0));
  std::vector<ProjectedPoint<S>> points;
  for (ContactConstraint<S>& contact : contacts)
    project_manifold(BodyPair<S>(bodies, contact), contact, slop, points);
}

}  // namespace contactscope
