#pragma once

#include <cmath>

#include "dynamics/constraint.h"
#include "dynamics/solver.h"

/// The constraints of a step, and what they keep for the next one. Warm starting: Gregorius 2015,
/// "Contact IDs"; Catto 2006, "Fast and Simple Physics using Sequential Impulses". A manifold is made
/// anew in each frame; a point that has the id of a point before is the same point, and begins with
/// what that one ended with.
namespace contactscope {

/// Each point begins with the impulse of its id; new points begin with zero. Where one id stands
/// several times, the first goes to the first. Friction is turned into the new contact plane.
template <class S>
void recall_impulses(const PairImpulses<S>& kept, ContactConstraint<S>& contact, int substeps) {
  std::vector<bool> taken(kept.size(), false);
  for (ConstraintPoint<S>& point : contact.points) {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const PointImpulse<S>& before = kept[i];
      if (taken[i] || before.id != point.id || before.triangle != point.triangle) continue;
      taken[i] = true;
      point.normal_impulse = before.normal;
      point.friction_u = before.friction.dot(contact.tangent_u);
      point.friction_v = before.friction.dot(contact.tangent_v);
      point.warm_start = static_cast<S>(substeps) * before.normal;
      break;
    }
  }
}

/// Appends what the points of `contact` got.
template <class S>
void keep_impulses(const ContactConstraint<S>& contact, PairImpulses<S>& kept) {
  for (const ConstraintPoint<S>& point : contact.points) {
    PointImpulse<S>& impulse = kept.emplace_back();
    impulse.triangle = point.triangle;
    impulse.id = point.id;
    impulse.normal = point.normal_impulse;
    impulse.friction = point.friction_u * contact.tangent_u + point.friction_v * contact.tangent_v;
    impulse.total_normal = point.total_normal;
    impulse.total_friction = point.total_u * contact.tangent_u + point.total_v * contact.tangent_v;
    impulse.warm_start = point.warm_start;
  }
}

/// How much relative velocity along the unit vector `direction` one newton second makes there, 1/kg.
template <class S>
S inverse_effective_mass(const BodyPair<S>& bodies, const ConstraintPoint<S>& point,
                         const Vec3<S>& direction) {
  const Vec3<S> lever_a = point.arm_a.cross(direction);
  const Vec3<S> lever_b = point.arm_b.cross(direction);
  const Vec3<S> turned_a = bodies.a.inverse_inertia_world * lever_a;
  const Vec3<S> turned_b = bodies.b.inverse_inertia_world * lever_b;
  return bodies.inverse_mass() + (lever_a.dot(turned_a) + lever_b.dot(turned_b));
}

/// The larger eigenvalue of how the two tangents yield, 1/kg. Friction that is corrected by no more
/// than this one allows meets its end where it opposes the slip; with one for each tangent, it would
/// end beside that direction wherever a body yields more one way than the other.
template <class S>
S most_yielding(const BodyPair<S>& bodies, const ConstraintPoint<S>& point, const Vec3<S>& u,
                const Vec3<S>& v) {
  const S uu = inverse_effective_mass(bodies, point, u);
  const S vv = inverse_effective_mass(bodies, point, v);
  const Vec3<S> turned_a = bodies.a.inverse_inertia_world * point.arm_a.cross(u);
  const Vec3<S> turned_b = bodies.b.inverse_inertia_world * point.arm_b.cross(u);
  const S uv = turned_a.dot(point.arm_a.cross(v)) + turned_b.dot(point.arm_b.cross(v));
  const S mean = S(0.5) * (uu + vv), half = S(0.5) * (uu - vv);
  return mean + std::sqrt(half * half + uv * uv);
}

template <class S>
ConstraintPoint<S> prepare_point(const BodyPair<S>& bodies, const ContactConstraint<S>& contact,
                                 const ContactPoint<S>& found) {
  const Body<S>&a = bodies.a.body, &b = bodies.b.body;
  ConstraintPoint<S> point;
  point.arm_a = found.position - a.center;
  point.arm_b = found.position - b.center;
  point.anchor_a = a.rotation.conjugate() * point.arm_a;
  point.anchor_b = b.rotation.conjugate() * point.arm_b;
  point.separation_began = point.separation = found.separation;
  point.normal_mass = S(1) / inverse_effective_mass(bodies, point, contact.normal);
  point.tangent_mass = S(1) / most_yielding(bodies, point, contact.tangent_u, contact.tangent_v);
  point.id = found.id;
  return point;
}

/// Constraints from contacts: arms, tangents, effective masses, and where warm starting is on what
/// `kept` (one a pair) holds of the step before. Pairs without a dynamic body, and points of which
/// the geometry made no numbers, are left out. In the order of pairs, manifolds, points.
template <class S>
std::vector<ContactConstraint<S>> prepare_contacts(std::span<SolverBody<S>> bodies,
                                                   std::span<const PairContacts<S>> pairs,
                                                   std::span<const PairImpulses<S>> kept,
                                                   const SolverSettings& settings) {
  std::vector<ContactConstraint<S>> contacts;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const PairContacts<S>& pair = pairs[p];
    const BodyPair<S> both(bodies, pair.a, pair.b);
    if (pair.manifolds == nullptr || !(both.inverse_mass() > 0)) continue;
    for (const Manifold<S>& manifold : *pair.manifolds) {
      ContactConstraint<S> contact;
      contact.a = pair.a;
      contact.b = pair.b;
      contact.pair = static_cast<int>(p);
      contact.normal = manifold.normal;
      contact.tangent_u = any_perpendicular(manifold.normal);
      contact.tangent_v = manifold.normal.cross(contact.tangent_u);
      contact.friction = pair.friction;
      contact.restitution = pair.restitution;
      for (const ContactPoint<S>& found : manifold.points) {
        ConstraintPoint<S> point = prepare_point(both, contact, found);
        point.triangle = manifold.triangle;
        if (std::isfinite(point.normal_mass) && std::isfinite(point.separation))
          contact.points.push_back(point);
      }
      if (settings.warm_start) recall_impulses(kept[p], contact, settings.substeps);
      if (!contact.points.empty()) contacts.push_back(std::move(contact));
    }
  }
  return contacts;
}

/// How far apart a point is where the bodies are now: what it was, and how far the anchors have come
/// apart along the normal since.
template <class S>
S separation_now(const BodyPair<S>& bodies, const ConstraintPoint<S>& point,
                 const Vec3<S>& normal) {
  const SolverBody<S>&a = bodies.a, &b = bodies.b;
  // Each is how far the anchor has come; differences of small ways, never of places.
  const Vec3<S> of_a = a.moved + (a.body.rotation * point.anchor_a - point.arm_a);
  const Vec3<S> of_b = b.moved + (b.body.rotation * point.anchor_b - point.arm_b);
  return point.separation_began + (of_b - of_a).dot(normal);
}

template <class S>
void update_separations(std::span<SolverBody<S>> bodies,
                        std::vector<ContactConstraint<S>>& contacts) {
  for (ContactConstraint<S>& contact : contacts) {
    const BodyPair<S> pair(bodies, contact);
    for (ConstraintPoint<S>& point : contact.points)
      point.separation = separation_now(pair, point, contact.normal);
  }
}

}  // namespace contactscope
