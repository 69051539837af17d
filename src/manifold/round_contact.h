#pragma once

#include "geometry/shape.h"
#include "manifold/contact.h"
#include "query/hull_feature.h"

/// Shared by spheres and capsules: a contact between two points with radii.
///
/// Two spheres, or two capsules, are processed in an order of their own, so that swapping the
/// arguments mirrors the result: the larger radius first, then by their other numbers.
namespace contactscope {

/// Lexicographic comparison of two vectors: less (-1), equal (0) or more (1).
template <class V> int order_of(const V& one, const V& other) {
  for (int i = 0; i < static_cast<int>(one.size()); ++i)
    if (one[i] != other[i]) return one[i] < other[i] ? -1 : 1;
  return 0;
}

template <class S> int order_of(const Sphere<S>& a, const Sphere<S>& b) {
  if (a.radius != b.radius) return a.radius < b.radius ? -1 : 1;
  return 0;
}
template <class S> int order_of(const Capsule<S>& a, const Capsule<S>& b) {
  // Capsules of one scene usually have the same seven numbers: compared a pack at a time.
  constexpr int kNumbers = 7, kWidth = lanes::kWidth<S>;
  static_assert(sizeof(Capsule<S>) == kNumbers * sizeof(S));
  const S *const of_a = a.points[0].data(), *const of_b = b.points[0].data();
  lanes::Flags<S> differ = {};
  for (int i = 0; i < kNumbers; i += kWidth) {
    const int first = std::min(i, kNumbers - kWidth);
    differ |= lanes::load<S>(of_a + first) != lanes::load<S>(of_b + first);
  }
  if (lanes::bits<S>(differ) == 0) return 0;
  if (a.radius != b.radius) return a.radius < b.radius ? -1 : 1;
  const int order = order_of(a.points[0], b.points[0]);
  return order != 0 ? order : order_of(a.points[1], b.points[1]);
}
template <class S> int order_of(const Pose<S>& a, const Pose<S>& b) {
  if (a.rotation.w() != b.rotation.w()) return a.rotation.w() < b.rotation.w() ? -1 : 1;
  if (const int order = order_of(a.rotation.vec(), b.rotation.vec())) return order;
  return order_of(a.position, b.position);
}

/// Whether B comes first. `b_first` decides for pairs that are equal in everything.
template <class S, class Round>
bool against_order(const Round& a, const Pose<S>& pose_a, const Round& b, const Pose<S>& pose_b,
                   bool b_first) {
  int order = order_of(a, b);
  if (order == 0) order = order_of(pose_a, pose_b);
  return order < 0 || (order == 0 && b_first);
}

/// Length without intermediate overflow or underflow, whatever the components.
template <class S> S safe_norm(const Vec3<S>& v) {
  const S largest = v.cwiseAbs().maxCoeff();
  return largest > S(0) ? largest * Vec3<S>(v / largest).norm() : S(0);
}

/// `v` at length one, also for denormal lengths of few digits; zero stays zero.
template <class S> Vec3<S> safe_unit(const Vec3<S>& v) {
  const S largest = v.cwiseAbs().maxCoeff();
  if (!(largest > S(0))) return Vec3<S>::Zero();
  const Vec3<S> scaled = v / largest;
  return scaled / scaled.norm();
}

/// The part of `v` perpendicular to `unit`.
template <class S> Vec3<S> rejected(const Vec3<S>& v, const Vec3<S>& unit) {
  return v - v.dot(unit) * unit;
}

/// A direction perpendicular to a capsule's axis `along`, both in the capsule's own frame; y if the
/// axis has length zero. It depends on the shape alone, so it turns with the body.
template <class S> Vec3<S> body_perpendicular(const Vec3<S>& along) {
  const Vec3<S> unit = safe_unit(along);
  return unit.isZero(S(0)) ? Vec3<S>(Vec3<S>::UnitY()) : any_perpendicular(unit);
}

/// The feature of a capsule's axis at `parameter`; an axis of length zero is its first end.
template <class S> FeatureRef axis_feature(Owner owner, S parameter, bool has_length = true) {
  if (!has_length || parameter <= S(0)) return vertex_ref(owner, 0);
  return parameter >= S(1) ? vertex_ref(owner, 1) : edge_ref(owner, 0);
}

/// The id of an end of a segment clipped to a face or an edge; `cut` made the cut. At a face edges
/// make the cuts, along an edge its vertices.
inline FeatureId clip_id(int end, int cut_by, const FeatureRef& uncut, const FeatureRef& cut) {
  if (cut_by < 0) return FeatureId::of(vertex_ref(Owner::A, end), uncut);
  return FeatureId::of(edge_ref(Owner::A, 0), cut);
}

/// Adds the contact point between two balls of `radius_a` and `radius_b` about `core_a` and
/// `core_b` along `normal` (unit, from A to B): midway between the two surface points, as in the
/// talk. `distance` is that of the cores along the normal. Everything in A's frame, metres.
template <class S>
void add_round_point(const Vec3<S>& core_a, S radius_a, const Vec3<S>& core_b, S radius_b,
                     const Vec3<S>& normal, S distance, const FeatureId& id, Contact<S>& contact) {
  const Vec3<S> on_a = core_a + radius_a * normal;
  const Vec3<S> on_b = core_b - radius_b * normal;
  contact.points.push_back({S(0.5) * (on_a + on_b), distance - (radius_a + radius_b), id});
}

// Shared by the pairs with hulls, in the hull's own frame, where its lanes and vertices are exact.

/// A core nearer to a vertex or an edge than this touches it. Closer, an ulp of the coordinates
/// could turn the difference of the closest points by up to 90 degrees.
template <class S> S touching_distance(S scale) {
  return S(16) * std::numeric_limits<S>::epsilon() * scale;
}

/// Directions with a smaller sine of their angle are nearly parallel. Separations along both then
/// differ by 0.1%, a fiftieth of what a preference between axes accepts.
template <class S> constexpr S kNearlyParallelSine = S(0.05);

/// Upper bound of all coordinates in both frames. `core_reach`: of the round shape in its own.
template <class S> S length_scale(const Hull<S>& hull, const Pose<S>& b_in_a, S core_reach) {
  return hull.centroid.norm() + hull.radius + b_in_a.position.norm() + core_reach;
}

/// The contact of a capsule's axis, from one end to the other in the hull's frame, with a face of the
/// hull: the ends of its part over the face. No points where it is not over the face.
template <class S>
void touch_along_face(const Hull<S>& hull, const Pose<S>& hull_in_a, int face,
                      const Vec3<S> (&ends)[2], S radius, S margin, Contact<S>& contact) {
  const ClippedSegment<S> clipped = clip_to_prism(hull, face, ends, S(0));
  if (clipped.empty()) return;
  const Plane<S>& plane = at(hull.planes, face);
  contact.axis = AxisKind::FaceB;
  contact.normal = -hull_in_a.rotate(plane.normal);
  const int count = clipped.parameters[0] < clipped.parameters[1] ? 2 : 1;
  for (int end = 0; end < count; ++end) {
    const Vec3<S> core = ends[0] + clipped.parameters[end] * (ends[1] - ends[0]);
    const S distance = plane.distance(core);
    if (distance - radius > margin) continue;
    const int cut_by = clipped.edges[end];
    const FeatureId id =
        clip_id(end, cut_by, face_ref(Owner::B, face), edge_ref(Owner::B, cut_by / 2));
    contact.points.push_back({hull_in_a.transform(plane.project(core)), distance - radius, id});
  }
  contact.type = face_contact_type(contact.points.size());
}

}  // namespace contactscope
