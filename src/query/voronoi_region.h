#pragma once

#include <limits>
#include <optional>

#include "query/hull_feature.h"

namespace contactscope {

/// The half-edge of a face outside of whose side plane a point is farthest; -1 where the point is
/// over the face, as projects_into() has it with no thickness.
template <class S>
int side_beside(const Hull<S>& hull, int face, const Vec3<S>& point) {
  const Vec3<S>& normal = at(hull.planes, face).normal;
  int best = -1;
  S farthest = S(0), squared_length = S(1);  // both times the edge's, squared
  for (const int edge : hull.around_face(face)) {
    const Vec3<S>& origin = hull.origin(edge);
    const Vec3<S> along = hull.target(edge) - origin;
    const S outside = along.cross(normal).dot(Vec3<S>(point - origin));
    const S squared_along = along.squaredNorm();
    const bool is_farther = outside > S(0) && (best < 0 || outside * outside * squared_length >
                                                               farthest * squared_along);
    farthest = is_farther ? outside * outside : farthest;
    squared_length = is_farther ? squared_along : squared_length;
    best = is_farther ? edge : best;
  }
  return best;
}

/// The edge or vertex of a hull that is nearest to a point outside, as a half-edge or a vertex;
/// nothing where two features are as near within rounding, or where the point is over a face.
/// `half_edge` is where to begin: an edge of a face beside which the point lies. Hull's frame,
/// metres; no coordinate is larger than `scale`.
///
/// Lin and Canny, "A Fast Algorithm for Incremental Distance Calculation", 1991. The space outside
/// of a convex body falls into regions, one for each feature, of the points to which that feature
/// is nearest. Planes bound them: a few signs tell that a point is within, and a sign that is wrong
/// tells where to go.
///
///      over f  |  beside e     The region of an edge e lies between the side planes of its faces
///              |       .       f and g, and between the planes at right angles to it through its
///    ----f-----e     .         vertices. That of a vertex lies behind the planes through it at
///               \  .           right angles to its edges.
///              g \.  over g
///
/// What these signs do not decide by more than rounding is left to GJK.
template <class S>
std::optional<HullFeature> voronoi_region(const Hull<S>& hull, int half_edge, const Vec3<S>& point,
                                          S scale) {
  constexpr int kMostSteps = 8;
  const S rounding = S(64) * std::numeric_limits<S>::epsilon() * scale;
  const auto length = [](const Vec3<S>& v) {
    return v.cwiseAbs().sum();
  };  // up to 1.8 times too long
  int edge = half_edge;
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec3<S>& origin = hull.origin(edge);
    const Vec3<S> along = hull.target(edge) - origin;
    const Vec3<S> from_origin = point - origin;
    const Vec3<S> from_target = point - hull.target(edge);
    const S past_origin = along.dot(from_origin) - rounding * length(from_origin);
    const S before_target = -along.dot(from_target) - rounding * length(from_target);
    if (past_origin > S(0) && before_target > S(0)) {
      // How far beside the face on the left of either half-edge, times the edge's length.
      const auto beside = [&](int of, S sign) {
        const Vec3<S>& normal = at(hull.planes, at(hull.half_edges, of).face).normal;
        return sign * along.cross(normal).dot(from_origin);
      };
      const S least = rounding * length(along);
      const S beside_left = beside(edge, S(1)), beside_right = beside(Hull<S>::twin(edge), S(-1));
      if (beside_left > least && beside_right > least) return HullFeature{FeatureKind::Edge, edge};
      if (beside_left >= -least && beside_right >= -least) return std::nullopt;
      const int over = beside_left < -least ? edge : Hull<S>::twin(edge);
      const int face = at(hull.half_edges, over).face;
      edge = side_beside(hull, face, point);
      if (edge < 0) return std::nullopt;
      continue;
    }
    // At the vertex beyond which the point lies.
    const int leaving = past_origin > S(0) ? Hull<S>::twin(edge) : edge;
    const int vertex = at(hull.half_edges, leaving).origin;
    const Vec3<S> from_vertex = point - at(hull.vertices, vertex);
    const S least = rounding * length(from_vertex);
    S farthest = -std::numeric_limits<S>::infinity();
    for (const int candidate : hull.around_vertex(vertex)) {
      const S past = Vec3<S>(hull.target(candidate) - hull.origin(candidate)).dot(from_vertex);
      if (past > farthest) {
        farthest = past;
        edge = candidate;
      }
    }
    if (farthest < -least) return HullFeature{FeatureKind::Vertex, vertex};
    if (farthest <= least) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace contactscope
