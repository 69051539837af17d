#pragma once

#include "core/pose.h"
#include "geometry/half_space.h"
#include "manifold/contact.h"

/// What the pairs with a plane share. The plane is always B, and it is treated as a hull's face that
/// has no end: points move onto it, as the talk moves the points of a face contact onto the
/// reference face ("Face Contact Clipping"). So a floor gives the same manifold whether it is a
/// plane or the top of a wide box, and the points share a plane, as reducers want them. The lecture
/// on contact generation ("Box-Plane Contact Generation") puts them midway between the corner and
/// the plane instead: half the depth further along the normal.
namespace contactscope {

/// Shapes whose ends differ in height by less than this part of their size lie level. The preference
/// of the separating axis test has the same size: 0.2%, a tenth of a degree. Depth has no part in
/// it: which feature lies lowest does not change as it sinks.
template <class S>
inline constexpr S kLevel = S(0.002);

/// The boundary of `half_space` in A's frame.
template <class S>
Plane<S> plane_in_a(const HalfSpace<S>& half_space, const Pose<S>& b_in_a) {
  const Vec3<S> normal = b_in_a.rotate(half_space.plane.normal);
  return {normal, half_space.plane.offset + normal.dot(b_in_a.position)};
}

/// Begins a contact of A with that plane: the normal points into the ground.
template <class S>
void begin_plane_contact(const Plane<S>& plane, ContactType type, Contact<S>& contact) {
  contact.axis = AxisKind::FaceB;
  contact.type = type;
  contact.normal = -plane.normal;
}

/// The point below the ball of `radius` about vertex `index` of A, `height` above the plane. Metres,
/// A's frame.
template <class S>
ContactPoint<S> plane_point(const Plane<S>& plane, const Vec3<S>& core, S height, S radius,
                            int index) {
  const FeatureId id = FeatureId::of(vertex_ref(Owner::A, index), face_ref(Owner::B, 0));
  return {core - height * plane.normal, height - radius, id};
}

}  // namespace contactscope
