#pragma once

#include "core/feature_id.h"
#include "query/gjk.h"

/// Features of a hull, and the prism over a face, bounded by the face's side planes: Gregorius
/// 2015, "Capsule vs Hull: Clipping". Hull's frame, metres. Points within `thickness` (>= 0, up to
/// a factor of 1.8) of a side plane are on it.
namespace contactscope {

/// A vertex, an edge (as a half-edge) or a face of a hull.
struct HullFeature {
  FeatureKind kind = FeatureKind::Vertex;
  int index = -1;
  bool operator==(const HullFeature&) const = default;
  FeatureRef ref(Owner owner) const {
    return {owner, kind, static_cast<std::uint32_t>(kind == FeatureKind::Edge ? index / 2 : index)};
  }
};

/// The corners of a feature, in the order of around_face. Hull's frame.
template <class S>
std::vector<Vec3<S>> corners_of(const Hull<S>& hull, const HullFeature& feature) {
  if (feature.kind == FeatureKind::Vertex) return {at(hull.vertices, feature.index)};
  if (feature.kind == FeatureKind::Edge)
    return {hull.origin(feature.index), hull.target(feature.index)};
  std::vector<Vec3<S>> corners;
  for (const int edge : hull.around_face(feature.index)) corners.push_back(hull.origin(edge));
  return corners;
}

/// The smallest feature that contains all points of B in a GJK simplex, where B is `hull`: the
/// feature of its closest point. Two vertices of a face that share no edge belong to the face. If
/// rounding at nearly coplanar faces leaves no such feature, the result is a face with index -1.
template <class S> HullFeature feature_of_b(const Hull<S>& hull, const GjkSimplex<S>& simplex);

/// The closest edge of a face, as a half-edge of it, to a point that is not over the face: the edge
/// whose side plane the point is farthest outside of. Hull's frame.
template <class S> int nearest_outside_edge(const Hull<S>& hull, int face, const Vec3<S>& point);

/// True if the foot of the perpendicular from `point` to the face's plane is inside the face.
template <class S>
bool projects_into(const Hull<S>& hull, int face, const Vec3<S>& point, S thickness);

/// Rest of a segment: from parameters[0] to parameters[1], in [0, 1]; empty if they are reversed.
template <class S> struct ClippedSegment {
  S parameters[2] = {0, 1};
  /// Half-edges of the sides that clipped the two ends; -1: the segment's own end.
  int edges[2] = {-1, -1};
  bool empty() const { return parameters[0] > parameters[1]; }
};

/// The part of the segment between two points that is in the prism over `face`. Cyrus and Beck
/// 1978: each side plane moves one of the two ends of the interval.
template <class S>
ClippedSegment<S> clip_to_prism(const Hull<S>& hull, int face, const Vec3<S> (&ends)[2],
                                S thickness);

/// The part of the segment alongside an edge: between the planes through its vertices,
/// perpendicular to it. A clipped end stores the half-edge that leaves the vertex.
template <class S>
ClippedSegment<S> clip_to_edge(const Hull<S>& hull, int half_edge, const Vec3<S> (&ends)[2]);

/// Initial simplex: a point of the core and a nearby edge of the hull, few steps from the end.
template <class S> GjkSimplex<S> simplex_near(const Hull<S>& hull, int half_edge, int core_point) {
  GjkSimplex<S> simplex;
  simplex.weights = {};
  for (const int edge : {half_edge, Hull<S>::twin(half_edge)}) {
    const int vertex = at(hull.half_edges, edge).origin;
    simplex.vertices.push_back({core_point, vertex, Vec3<S>::Zero(), Vec3<S>::Zero()});
  }
  return simplex;
}

}  // namespace contactscope
