#pragma once

#include <cmath>
#include <limits>

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

/// `v` at length one, also where its length is a denormal number of few digits; zero stays zero.
template <class S>
Vec3<S> safe_unit(const Vec3<S>& v) {
  const S largest = v.cwiseAbs().maxCoeff();
  if (!(largest > S(0))) return Vec3<S>::Zero();
  const Vec3<S> scaled = v / largest;
  return scaled / scaled.norm();
}

/// The part of `v` at right angles to `unit`.
template <class S>
Vec3<S> rejected(const Vec3<S>& v, const Vec3<S>& unit) {
  return v - v.dot(unit) * unit;
}

/// A direction at right angles to a capsule's axis `along`, both in the capsule's own frame; that of
/// y if the axis has length zero. It depends on the shape alone, so that it turns with the body.
template <class S>
Vec3<S> body_perpendicular(const Vec3<S>& along) {
  const Vec3<S> unit = safe_unit(along);
  return unit.isZero(S(0)) ? Vec3<S>(Vec3<S>::UnitY()) : any_perpendicular(unit);
}

/// The feature of a capsule's axis at `parameter`: one of its ends or the edge between them. An axis
/// of length zero is its first end.
template <class S>
FeatureRef axis_feature(Owner owner, S parameter, bool has_length) {
  if (!has_length || parameter <= S(0)) return vertex_ref(owner, 0);
  return parameter >= S(1) ? vertex_ref(owner, 1) : edge_ref(owner, 0);
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
