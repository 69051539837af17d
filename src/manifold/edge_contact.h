#pragma once

#include "manifold/contact.h"
#include "query/sat.h"

namespace contactscope {

/// A's frame, metres.
template <class S> struct ClosestPoints {
  Vec3<S> on_a;
  Vec3<S> on_b;
};

/// Closest points of the two edges that an edge query found, of PlacedHull or PlacedFeatures.
///
/// Closest points of the two lines by Cramer's rule on the cross product of the directions, then
/// clamped to the edges as in Ericson, "Real-Time Collision Detection", 5.1.9. With unit directions
/// u, v and c = u x v the determinant is |c|^2. Ericson's 1 - (u . v)^2 is equal in exact
/// arithmetic, but for edges at 1e-3 rad it keeps one of a float's seven digits.
template <class PlacedA, class PlacedB, class S>
ClosestPoints<S> closest_points(const PlacedA& a, const PlacedB& b, const EdgeQuery<S>& query) {
  const int edge_a = query.edge_a, edge_b = query.edge_b;
  const Vec3<S> u = a.direction(edge_a), v = b.direction(edge_b);
  const Vec3<S> origin_a = a.origin(edge_a), origin_b = b.origin(edge_b);
  const S length_a = u.dot(Vec3<S>(a.origin(edge_a ^ 1) - origin_a));
  const S length_b = v.dot(Vec3<S>(b.origin(edge_b ^ 1) - origin_b));
  const Vec3<S> between = origin_b - origin_a;
  const Vec3<S> c = u.cross(v);
  const Vec3<S> v_side = between.cross(v);
  S along_a = std::clamp(v_side.dot(c) / c.squaredNorm(), S(0), length_a);
  // From here on each end is the closest point of its edge to the other end.
  const Vec3<S> from_b = origin_a + along_a * u - origin_b;
  const S along_b = std::clamp(v.dot(from_b), S(0), length_b);
  const Vec3<S> from_a = origin_b + along_b * v - origin_a;
  along_a = std::clamp(u.dot(from_a), S(0), length_a);
  return {origin_a + along_a * u, origin_b + along_b * v};
}

/// Gregorius 2015, "Hull vs Hull: Edge Contact": one point midway between the closest points of the
/// two edges, separation from the separating axis test, id the two edges. Overwrites `contact`.
template <class S>
void create_edge_contact(const ClosestPoints<S>& closest, const EdgeQuery<S>& query,
                         Contact<S>& contact) {
  const Vec3<S> middle = S(0.5) * (closest.on_a + closest.on_b);
  const FeatureId id =
      FeatureId::of(edge_ref(Owner::A, query.edge_a / 2), edge_ref(Owner::B, query.edge_b / 2));
  contact.axis = AxisKind::EdgeEdge;
  contact.type = ContactType::EdgeEdge;
  contact.normal = query.normal;
  contact.points.clear();
  contact.points.push_back({middle, query.separation, id});
}

}  // namespace contactscope
