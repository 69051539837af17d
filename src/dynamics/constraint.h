#pragma once

#include "dynamics/solver.h"

/// Constraints of a step, and the impulses kept for the next one. Warm starting: Gregorius 2015,
/// "Contact IDs"; Catto 2006, "Fast and Simple Physics using Sequential Impulses". Each frame makes
/// a new manifold. A point with an earlier point's id starts with its last impulses.
namespace contactscope {

/// A body during one step of the solver. Its position is its displacement since the step began: far
/// from the origin, coordinates cannot resolve the motion of a sub-step; the displacement can.
template <class S> struct SolverBody {
  Body<S> body;                                     // `center` is that at the beginning of the step
  Vec3<S> moved = Vec3<S>::Zero();                  // of the centre since then, metres
  Mat3<S> inverse_inertia_world = Mat3<S>::Zero();  // at the current rotation
  Vec3<S> velocity_began = Vec3<S>::Zero();         // when the sub-step began; note_approach()
  Vec3<S> spin_began = Vec3<S>::Zero();             // the same, radians per second
  bool stirred = false;                             // by a bounce in this sub-step

  /// Updates the world inertia to the current rotation.
  void turn_inertia() {
    if (!body.dynamic()) return;
    const Mat3<S> axes = body.rotation.toRotationMatrix();
    const Mat3<S> half = axes * body.inverse_inertia;
    inverse_inertia_world = half * axes.transpose();
  }
  /// Applies an impulse (newton seconds, world) at `arm` from the centre of mass.
  void apply_impulse(const Vec3<S>& impulse, const Vec3<S>& arm) {
    body.velocity += body.inverse_mass * impulse;
    const Vec3<S> torque = arm.cross(impulse);
    body.angular_velocity += inverse_inertia_world * torque;
  }
  /// Turns by Cayley's rotation of twice `half_turn` (radians, world).
  void turn(const Vec3<S>& half_turn) {
    body.rotation = Quat<S>(S(1), half_turn.x(), half_turn.y(), half_turn.z()) * body.rotation;
    body.rotation.normalize();
  }
  /// Moves a dynamic body by `offset`, metres, and turns it by `turned`, radians, world.
  void displace(const Vec3<S>& offset, const Vec3<S>& turned) {
    if (!body.dynamic()) return;
    moved += offset;
    if (turned.isZero(S(0))) return;
    const Vec3<S> local = body.rotation.conjugate() * body.angular_velocity;
    const Vec3<S> spin = body.rotation * Vec3<S>(body.inertia * local);
    turn(Vec3<S>(S(0.5) * turned));
    turn_inertia();
    body.angular_velocity = inverse_inertia_world * spin;
  }
};

/// Data of one contact point during a step. Impulses are newton seconds on b; a gets the opposite.
template <class S> struct ConstraintPoint {
  Vec3<S> arm_a, arm_b;  // from the centres of mass to the points of action, world; see follow()
  // When the step began: from the centres of mass to the cores (a ball's centre, a capsule's axis,
  // a hull's point), in world and own axes; and from there to the point, metres along the normal.
  Vec3<S> core_a, core_b;
  Vec3<S> anchor_a, anchor_b;
  S reach_a = 0, reach_b = 0;
  S separation_began = 0;  // metres along the normal, when the step began
  S separation = 0;        // at the current poses; see update_separations
  S normal_mass = 0;       // kg
  S tangent_mass = 0;      // kg, along the tangent that yields most
  S approach = 0;          // relative velocity along the normal when the sub-step began, m/s
  S bounce = 0;  // separating velocity, m/s, or limit of the closing one (< 0); see bounce()
  S position_target = 0;  // separation that position correction leaves, metres

  S normal_impulse = 0;   // of this sub-step, never negative
  S stopped_impulse = 0;  // the same before the bounce
  S friction_u = 0;       // along the tangents
  S friction_v = 0;
  S position_impulse = 0;  // kg m, by the position correction of this sub-step

  S warm_start = 0;    // along the normal, over the whole step, if unchanged
  S total_normal = 0;  // over the whole step
  S total_u = 0;
  S total_v = 0;

  int triangle = -1;  // of a mesh
  FeatureId id;
};

/// Constraints of the points of one manifold.
template <class S> struct ContactConstraint {
  int a = 0, b = 0;                                                    // bodies
  int pair = 0;                                                        // index of the pair
  Vec3<S> normal = Vec3<S>::UnitY();                                   // unit, from a to b
  Vec3<S> tangent_u = Vec3<S>::UnitX(), tangent_v = Vec3<S>::UnitZ();  // unit, perpendicular
  Vec3<S> normal_began = Vec3<S>::UnitY();                             // when the step began
  Vec3<S> moved = Vec3<S>::Zero();  // of b relative to a, at follow()
  S share_a = 0;        // of the gap between the arms' ends, closed by a's; see follow()
  S core_distance = 0;  // between two round shapes when the step began, metres; else 0
  S friction = 0;
  S restitution = 0;
  std::vector<ConstraintPoint<S>> points;
};

/// The two bodies of a contact.
template <class S> struct BodyPair {
  SolverBody<S>& a;
  SolverBody<S>& b;

  BodyPair(std::span<SolverBody<S>> bodies, int index_a, int index_b)
      : a(at(bodies, index_a)), b(at(bodies, index_b)) {}
  BodyPair(std::span<SolverBody<S>> bodies, const ContactConstraint<S>& contact)
      : BodyPair(bodies, contact.a, contact.b) {}

  S inverse_mass() const { return a.body.inverse_mass + b.body.inverse_mass; }

  /// Gregorius 2015, "Recap: Solving Contact (2)": v2 + w2 x r2 - v1 - w1 x r1, metres per second.
  /// Along the normal from a to b, negative values close the contact.
  Vec3<S> velocity_at(const ConstraintPoint<S>& point) const {
    const Vec3<S> of_a = a.body.velocity + a.body.angular_velocity.cross(point.arm_a);
    const Vec3<S> of_b = b.body.velocity + b.body.angular_velocity.cross(point.arm_b);
    return of_b - of_a;
  }
  /// Gregorius 2015, "Recap: Solving Contact (3)": applies an impulse (newton seconds, world) to b
  /// and its opposite to a. Infinite masses do not react.
  void push(const ConstraintPoint<S>& point, const Vec3<S>& impulse) const {
    a.apply_impulse(Vec3<S>(-impulse), point.arm_a);
    b.apply_impulse(impulse, point.arm_b);
  }
};

/// Calls visit(bodies, contact, point) for every point, in order.
template <class S, class Visit>
void for_each_point(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                    const Visit& visit) {
  for (ContactConstraint<S>& contact : contacts) {
    const BodyPair<S> pair(bodies, contact);
    for (ConstraintPoint<S>& point : contact.points) visit(pair, contact, point);
  }
}

/// Gives each point the impulse of its id, and zero to new points. Points with the same id are
/// matched in order. Friction is rotated into the new contact plane.
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

/// Appends the impulses of the points of `contact`.
template <class S> void keep_impulses(const ContactConstraint<S>& contact, PairImpulses<S>& kept) {
  const auto along_plane = [&](S u, S v) -> Vec3<S> {
    return u * contact.tangent_u + v * contact.tangent_v;
  };
  for (const ConstraintPoint<S>& point : contact.points)
    kept.push_back({point.triangle, point.id, point.normal_impulse,
                    along_plane(point.friction_u, point.friction_v), point.total_normal,
                    along_plane(point.total_u, point.total_v), point.warm_start});
}

/// Velocity along unit `v` that one newton second along `u` causes at the point by rotation, 1/kg.
template <class S>
S turned_along(const BodyPair<S>& bodies, const ConstraintPoint<S>& point, const Vec3<S>& u,
               const Vec3<S>& v) {
  const Vec3<S> turned_a = bodies.a.inverse_inertia_world * point.arm_a.cross(u);
  const Vec3<S> turned_b = bodies.b.inverse_inertia_world * point.arm_b.cross(u);
  return turned_a.dot(point.arm_a.cross(v)) + turned_b.dot(point.arm_b.cross(v));
}

/// The same along `direction` itself, including the bodies' translation.
template <class S>
S inverse_effective_mass(const BodyPair<S>& bodies, const ConstraintPoint<S>& point,
                         const Vec3<S>& direction) {
  return bodies.inverse_mass() + turned_along(bodies, point, direction, direction);
}

/// Larger eigenvalue of the inverse effective mass in the contact plane, 1/kg. Friction that uses
/// it for both tangents converges to the direction against the slip. With one mass per tangent it
/// would end off that direction for bodies that yield unequally.
template <class S>
S most_yielding(const BodyPair<S>& bodies, const ConstraintPoint<S>& point, const Vec3<S>& u,
                const Vec3<S>& v) {
  const S uu = inverse_effective_mass(bodies, point, u);
  const S vv = inverse_effective_mass(bodies, point, v);
  const S uv = turned_along(bodies, point, u, v);
  const S mean = S(0.5) * (uu + vv), half = S(0.5) * (uu - vv);
  return mean + std::sqrt(half * half + uv * uv);
}

/// Whether a separated point is reached before the bodies have slid past each other by a few times
/// `margin` (metres). Else its plane may have ended, and would stop a ball that flies past an edge.
template <class S>
bool is_met_head_on(const BodyPair<S>& bodies, const ConstraintPoint<S>& point,
                    const Vec3<S>& normal, S margin) {
  constexpr S kMaxSlides = 5;
  const Vec3<S> velocity = bodies.velocity_at(point);
  const S closing = -velocity.dot(normal);
  const Vec3<S> sliding = velocity + closing * normal;
  return closing > S(0) && sliding.norm() * point.separation <= kMaxSlides * margin * closing;
}

template <class S>
ConstraintPoint<S> prepare_point(const BodyPair<S>& bodies, const ContactConstraint<S>& contact,
                                 const PairContacts<S>& pair, const ContactPoint<S>& found) {
  const Body<S>&a = bodies.a.body, &b = bodies.b.body;
  ConstraintPoint<S> point;
  point.arm_a = found.position - a.center;
  point.arm_b = found.position - b.center;
  // Points of two round shapes are midway between the surfaces; of one, height does not matter.
  if (pair.round_a > S(0)) point.reach_a = pair.round_a + S(0.5) * found.separation;
  if (pair.round_b > S(0)) point.reach_b = -pair.round_b - S(0.5) * found.separation;
  point.core_a = point.arm_a - point.reach_a * contact.normal;
  point.core_b = point.arm_b - point.reach_b * contact.normal;
  point.anchor_a = a.rotation.conjugate() * point.core_a;
  point.anchor_b = b.rotation.conjugate() * point.core_b;
  point.separation_began = point.separation = found.separation;
  point.normal_mass = S(1) / inverse_effective_mass(bodies, point, contact.normal);
  point.tangent_mass = S(1) / most_yielding(bodies, point, contact.tangent_u, contact.tangent_v);
  point.id = found.id;
  return point;
}

/// Share of the gap between two arms' ends that a's arm closes, see follow(). The point stays fixed
/// on a round shape, which would else spin, or on the lighter body, whose corner it usually is.
template <class S> S share_of_a(const BodyPair<S>& bodies, const PairContacts<S>& pair) {
  const bool round_a = pair.round_a > S(0), round_b = pair.round_b > S(0);
  if (round_a != round_b && bodies.a.body.dynamic() && bodies.b.body.dynamic())
    return round_a ? S(0) : S(1);
  return bodies.b.body.inverse_mass / bodies.inverse_mass();
}

/// Constraints from contacts: arms, tangents, effective masses and, for warm starting, the impulses
/// of the previous step in `kept` (one per pair). Skips pairs without a dynamic body, points that
/// are not finite, and separated points that are not met head-on. Keeps the order.
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
      contact.normal = contact.normal_began = manifold.normal;
      contact.tangent_u = any_perpendicular(manifold.normal);
      contact.tangent_v = manifold.normal.cross(contact.tangent_u);
      contact.friction = pair.friction;
      contact.restitution = pair.restitution;
      contact.share_a = share_of_a(both, pair);
      if (pair.round_a > S(0) && pair.round_b > S(0) && !manifold.points.empty())
        contact.core_distance =
            std::max(pair.round_a + pair.round_b + manifold.points[0].separation, S(0));
      for (const ContactPoint<S>& found : manifold.points) {
        ConstraintPoint<S> point = prepare_point(both, contact, pair, found);
        point.triangle = manifold.triangle;
        if (!std::isfinite(point.normal_mass) || !std::isfinite(point.separation)) continue;
        if (point.separation > pair.margin &&
            !is_met_head_on(both, point, contact.normal, pair.margin))
          continue;
        contact.points.push_back(point);
      }
      if (settings.warm_start) recall_impulses(kept[p], contact, settings.substeps);
      if (!contact.points.empty()) contacts.push_back(std::move(contact));
    }
  }
  return contacts;
}

/// Removes the angular momentum (kg m^2 / s, world) that two dynamic bodies gained because their
/// centres were moved: the larger their distance, the slower they turn about each other. Most is
/// removed by opposite impulses at the centres, across the line between them, which add no spin.
/// The rest, along that line, turns the bodies that are not round.
template <class S>
void take_back(const BodyPair<S>& bodies, const ContactConstraint<S>& contact,
               const Vec3<S>& gained) {
  Body<S>&a = bodies.a.body, &b = bodies.b.body;
  if (gained.isZero(S(0)) || !a.dynamic() || !b.dynamic()) return;
  const ConstraintPoint<S>& point = contact.points.front();
  const Vec3<S> began =
      (point.core_a - point.core_b) + (point.reach_a - point.reach_b) * contact.normal_began;
  const Vec3<S> line = began + (bodies.b.moved - bodies.a.moved);  // from a's centre to b's
  const S squared = line.squaredNorm();
  if (!(squared > S(0))) return;
  const Vec3<S> back = line.cross(gained) / squared;
  a.velocity -= a.inverse_mass * back;
  b.velocity += b.inverse_mass * back;
  const Vec3<S> along = gained.dot(line) / squared * line;
  bodies.a.body.angular_velocity -= contact.share_a * (bodies.a.inverse_inertia_world * along);
  bodies.b.body.angular_velocity -=
      (S(1) - contact.share_a) * (bodies.b.inverse_inertia_world * along);
}

/// Separation of a point at the current poses: the one at the beginning, plus the growth of the
/// cores' separation along the normal since then.
template <class S>
S separation_now(const BodyPair<S>& bodies, const ContactConstraint<S>& contact,
                 const ConstraintPoint<S>& point) {
  const SolverBody<S>&a = bodies.a, &b = bodies.b;
  // Displacements of the anchors, from small differences, never from positions.
  const Vec3<S> of_a = a.moved + (a.body.rotation * point.anchor_a - point.core_a);
  const Vec3<S> of_b = b.moved + (b.body.rotation * point.anchor_b - point.core_b);
  S separation = point.separation_began + (of_b - of_a).dot(contact.normal);
  if (contact.core_distance > S(0))
    separation += contact.core_distance * (contact.normal_began.dot(contact.normal) - S(1));
  return separation;
}

/// Turns the normal of two round shapes with the line through their cores. After the bodies have
/// slid past each other, makes the arms meet in one point again: only then do an impulse and its
/// opposite keep angular momentum. Arms do not turn with the bodies within a step (Catto 2024,
/// "Solver2D": arms of the Jacobian are fixed), so a ball rolls on its lowest point.
template <class S> void follow(const BodyPair<S>& bodies, ContactConstraint<S>& contact) {
  const Vec3<S> moved = bodies.b.moved - bodies.a.moved;
  if (moved.isZero(S(0))) return;
  contact.moved = moved;
  const Vec3<S> cores = contact.core_distance * contact.normal_began + moved;
  const S distance = cores.norm();
  // Cores that have come much nearer, or have passed each other, have lost their direction.
  if (contact.core_distance > S(0) && distance > S(0.5) * contact.core_distance) {
    const Vec3<S> before = contact.normal;
    contact.normal = cores / distance;
    const Vec3<S> both = (before + contact.normal) / (S(1) + before.dot(contact.normal));
    contact.tangent_u -= contact.normal.dot(contact.tangent_u) * both;
    contact.tangent_v -= contact.normal.dot(contact.tangent_v) * both;
  }
  for (ConstraintPoint<S>& point : contact.points) {
    point.arm_a = point.core_a + point.reach_a * contact.normal;
    point.arm_b = point.core_b + point.reach_b * contact.normal;
    const Vec3<S> gap =
        moved + (point.reach_b - point.reach_a) * (contact.normal - contact.normal_began);
    point.arm_a += contact.share_a * gap;
    point.arm_b -= (S(1) - contact.share_a) * gap;
  }
}

template <class S>
void update_separations(std::span<SolverBody<S>> bodies,
                        std::vector<ContactConstraint<S>>& contacts) {
  for_each_point(bodies, contacts, [](const auto& pair, const auto& contact, auto& point) {
    point.separation = separation_now(pair, contact, point);
  });
}

}  // namespace contactscope
