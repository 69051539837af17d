#pragma once

#include "query/hull_feature.h"

namespace contactscope {

/// The half-edge of a face whose side plane a point is farthest outside of; -1 if the point is over
/// the face, as in projects_into() with thickness 0.
template <class S> int outside_side(const Hull<S>& hull, int face, const Vec3<S>& point) {
  const Vec3<S>& normal = at(hull.planes, face).normal;
  int best = -1;
  S farthest = S(0), squared_length = S(1);  // both scaled by the edge's squared length
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

/// The edge (as a half-edge) or vertex of a hull closest to a point outside; none if two are
/// equally close within rounding, or if the point is over a face. `half_edge`: where to start, of a
/// face that the point is not over. Hull's frame, metres; `scale` bounds all coordinates.
///
/// Lin and Canny, "A Fast Algorithm for Incremental Distance Calculation", 1991. Planes bound the
/// Voronoi regions outside a convex body: the points closest to one feature. A few signs show that
/// a point is inside one, and a wrong sign shows where to go next.
///
///      over f  |  region of e     The region of an edge e is between the side planes of its faces
///              |       .          f and g, and between the planes through its vertices that are
///    ----f-----e     .            perpendicular to e. The region of a vertex is behind the planes
///               \  .              through it that are perpendicular to its edges.
///              g \.  over g
///
/// GJK handles the points for which these signs are within rounding.
template <class S>
std::optional<HullFeature> voronoi_region(const Hull<S>& hull, int half_edge, const Vec3<S>& point,
                                          S scale) {
  constexpr int kMaxSteps = 8;
  const S rounding = S(64) * std::numeric_limits<S>::epsilon() * scale;
  const auto length = [](const Vec3<S>& v) {
    return v.cwiseAbs().sum();
  };  // overestimates by a factor of up to 1.8
  int edge = half_edge;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vec3<S>& origin = hull.origin(edge);
    const Vec3<S> along = hull.target(edge) - origin;
    const Vec3<S> from_origin = point - origin;
    const Vec3<S> from_target = point - hull.target(edge);
    const S past_origin = along.dot(from_origin) - rounding * length(from_origin);
    const S before_target = -along.dot(from_target) - rounding * length(from_target);
    if (past_origin > S(0) && before_target > S(0)) {
      // Distance outside of the face to the left of either half-edge, times the edge's length.
      const auto outside_of = [&](int of, S sign) {
        const Vec3<S>& normal = at(hull.planes, at(hull.half_edges, of).face).normal;
        return sign * along.cross(normal).dot(from_origin);
      };
      const S least = rounding * length(along);
      const S outside_left = outside_of(edge, S(1)),
              outside_right = outside_of(Hull<S>::twin(edge), S(-1));
      if (outside_left > least && outside_right > least)
        return HullFeature{FeatureKind::Edge, edge};
      if (outside_left >= -least && outside_right >= -least) return std::nullopt;
      const int over = outside_left < -least ? edge : Hull<S>::twin(edge);
      const int face = at(hull.half_edges, over).face;
      edge = outside_side(hull, face, point);
      if (edge < 0) return std::nullopt;
      continue;
    }
    // The point is beyond this vertex.
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
