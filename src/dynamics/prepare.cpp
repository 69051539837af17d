#include "dynamics/prepare.h"

#include <cmath>

namespace contactscope {
namespace {

/// The larger eigenvalue of how the two tangents yield, 1/kg. Friction that is corrected by no more
/// than this one allows meets its end where it opposes the slip; with one for each tangent, it would
/// end beside that direction wherever a body yields more one way than the other.
template <class S>
S most_yielding(const SolverBody<S>& a, const SolverBody<S>& b, const ConstraintPoint<S>& point,
                const Vec3<S>& u, const Vec3<S>& v) {
  const S uu = inverse_effective_mass(a, b, point.arm_a, point.arm_b, u);
  const S vv = inverse_effective_mass(a, b, point.arm_a, point.arm_b, v);
  const Vec3<S> turned_a = a.inverse_inertia_world * point.arm_a.cross(u);
  const Vec3<S> turned_b = b.inverse_inertia_world * point.arm_b.cross(u);
  const S uv = turned_a.dot(point.arm_a.cross(v)) + turned_b.dot(point.arm_b.cross(v));
  const S mean = S(0.5) * (uu + vv), half = S(0.5) * (uu - vv);
  return mean + std::sqrt(half * half + uv * uv);
}

template <class S>
ConstraintPoint<S> prepare_point(const SolverBody<S>& a, const SolverBody<S>& b,
                                 const ContactConstraint<S>& contact,
                                 const ContactPoint<S>& found) {
  ConstraintPoint<S> point;
  point.arm_a = found.position - a.body.center;
  point.arm_b = found.position - b.body.center;
  point.anchor_a = a.body.rotation.conjugate() * point.arm_a;
  point.anchor_b = b.body.rotation.conjugate() * point.arm_b;
  point.separation_began = point.separation = found.separation;
  point.normal_mass = S(1) / inverse_effective_mass(a, b, point.arm_a, point.arm_b, contact.normal);
  point.tangent_mass = S(1) / most_yielding(a, b, point, contact.tangent_u, contact.tangent_v);
  point.id = found.id;
  return point;
}

}  // namespace

template <class S>
std::vector<ContactConstraint<S>> prepare_contacts(std::span<const SolverBody<S>> bodies,
                                                   std::span<const PairContacts<S>> pairs,
                                                   std::span<const PairImpulses<S>> kept,
                                                   const SolverSettings& settings) {
  std::vector<ContactConstraint<S>> contacts;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const PairContacts<S>& pair = pairs[p];
    const SolverBody<S>& a = bodies[static_cast<std::size_t>(pair.a)];
    const SolverBody<S>& b = bodies[static_cast<std::size_t>(pair.b)];
    if (pair.manifolds == nullptr || !(a.body.dynamic() || b.body.dynamic())) continue;
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
        ConstraintPoint<S> point = prepare_point(a, b, contact, found);
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

template <class S>
S separation_now(const SolverBody<S>& a, const SolverBody<S>& b, const ConstraintPoint<S>& point,
                 const Vec3<S>& normal) {
  // Each is how far the anchor has come; differences of small ways, never of places.
  const Vec3<S> of_a = a.moved + (a.body.rotation * point.anchor_a - point.arm_a);
  const Vec3<S> of_b = b.moved + (b.body.rotation * point.anchor_b - point.arm_b);
  return point.separation_began + (of_b - of_a).dot(normal);
}

template <class S>
void update_separations(std::span<const SolverBody<S>> bodies,
                        std::vector<ContactConstraint<S>>& contacts) {
  for (ContactConstraint<S>& contact : contacts) {
    const SolverBody<S>& a = bodies[static_cast<std::size_t>(contact.a)];
    const SolverBody<S>& b = bodies[static_cast<std::size_t>(contact.b)];
    for (ConstraintPoint<S>& point : contact.points)
      point.separation = separation_now(a, b, point, contact.normal);
  }
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                                \
  template std::vector<ContactConstraint<S>> prepare_contacts(                                     \
      std::span<const SolverBody<S>>, std::span<const PairContacts<S>>,                            \
      std::span<const PairImpulses<S>>, const SolverSettings&);                                    \
  template S separation_now(const SolverBody<S>&, const SolverBody<S>&, const ConstraintPoint<S>&, \
                            const Vec3<S>&);                                                       \
  template void update_separations(std::span<const SolverBody<S>>,                                 \
                                   std::vector<ContactConstraint<S>>&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
