#pragma once

#include <cmath>

#include "manifold/collide_options.h"
#include "manifold/contact.h"

/// What spheres and capsules share: a contact between two points that carry radii.
namespace contactscope {

/// Length without overflow or underflow on the way, whatever the components.
template <class S>
S safe_norm(const Vec3<S>& v) {
  const S largest = v.cwiseAbs().maxCoeff();
  return largest > S(0) ? largest * Vec3<S>(v / largest).norm() : S(0);
}

/// Adds the contact point between a ball of `radius_a` about `core_a` and one of `radius_b` about
/// `core_b` along `normal` (unit, from A to B): in the middle of the two surface points, as the
/// talk puts it. `distance` is that of the two cores along the normal. Everything in A's frame,
/// metres.
template <class S>
void add_round_point(const Vec3<S>& core_a, S radius_a, const Vec3<S>& core_b, S radius_b,
                     const Vec3<S>& normal, S distance, const FeatureId& id, Contact<S>& contact) {
  const Vec3<S> on_a = core_a + radius_a * normal;
  const Vec3<S> on_b = core_b - radius_b * normal;
  contact.points.push_back({S(0.5) * (on_a + on_b), distance - (radius_a + radius_b), id});
}

}  // namespace contactscope
