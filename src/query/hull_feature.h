#pragma once

#include "core/feature_id.h"
#include "geometry/hull.h"
#include "query/gjk.h"

namespace contactscope {

/// A vertex, an edge (a half-edge of it) or a face of a hull.
struct HullFeature {
  FeatureKind kind = FeatureKind::Vertex;
  int index = -1;

  FeatureRef ref(Owner owner) const {
    return {owner, kind, static_cast<std::uint32_t>(kind == FeatureKind::Edge ? index / 2 : index)};
  }
};

/// The smallest feature that has all points of B in a simplex of GJK, where B is `hull`: the one
/// that its closest point lies on. Two vertices of a face that are no edge belong to the face. A
/// face without a number (index -1) where no feature has them all, which rounding does to faces that
/// are nearly coplanar.
template <class S>
HullFeature feature_of_b(const Hull<S>& hull, const GjkSimplex<S>& simplex);

/// The edge of a face, as its half-edge on that face, beside which a point lies that is not over the
/// face: of the side planes the one that it is farthest outside of. Hull's frame.
template <class S>
int edge_beside(const Hull<S>& hull, int face, const Vec3<S>& point);

/// For a warm start: a point of the core and the edge of the hull that is near. GJK has a few steps
/// to go from there.
template <class S>
GjkSimplex<S> simplex_near(const Hull<S>& hull, int half_edge, int core_point) {
  GjkSimplex<S> simplex;
  simplex.weights = {};
  for (const int edge : {half_edge, Hull<S>::twin(half_edge)}) {
    const int vertex = hull.half_edges[static_cast<std::size_t>(edge)].origin;
    simplex.vertices.push_back({core_point, vertex, Vec3<S>::Zero(), Vec3<S>::Zero()});
  }
  return simplex;
}

}  // namespace contactscope
