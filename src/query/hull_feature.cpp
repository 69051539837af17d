#include "query/hull_feature.h"

namespace contactscope {
namespace {

using Corners = StaticVector<int, 4>;  // vertices

bool has(const Corners& corners, int vertex) {
  return std::ranges::find(corners, vertex) != corners.end();
}

template <class S> bool has_all(const Hull<S>& hull, int face, const Corners& corners) {
  return std::ranges::count_if(hull.around_face(face), [&](int edge) {
           return has(corners, at(hull.half_edges, edge).origin);
         }) == count_of(corners);
}
/// Outward normal of a side plane with the length of its edge, which avoids a square root.
template <class S> struct SidePlane {
  SidePlane(const Hull<S>& hull, int half_edge, const Vec3<S>& face_normal)
      : origin(hull.origin(half_edge)),
        normal(Vec3<S>(hull.target(half_edge) - origin).cross(face_normal)),
        // Between 1 and 1.8 times the edge's length.
        length(normal.cwiseAbs().sum()) {}
  S distance(const Vec3<S>& point) const { return normal.dot(Vec3<S>(point - origin)); }
  const Vec3<S>& origin;
  Vec3<S> normal;
  S length;
};
/// Clips the interval where the distance from a plane exceeds `thickness`.
template <class S> void cut(S start, S end, S thickness, int edge, ClippedSegment<S>& clipped) {
  if (start <= thickness && end <= thickness) return;
  if (start > thickness && end > thickness) {
    clipped.parameters[0] = S(2);
    return;
  }
  const S crossing = std::clamp(start / (start - end), S(0), S(1));
  const int cut_end = start > end ? 0 : 1;
  S& parameter = clipped.parameters[cut_end];
  if (cut_end == 0 ? crossing > parameter : crossing < parameter) {
    parameter = crossing;
    clipped.edges[cut_end] = edge;
  }
}

}  // namespace

template <class S> HullFeature feature_of_b(const Hull<S>& hull, const GjkSimplex<S>& simplex) {
  Corners corners;
  for (const GjkVertex<S>& vertex : simplex.vertices)
    if (!has(corners, vertex.index_b)) corners.push_back(vertex.index_b);
  if (corners.size() == 1) return {FeatureKind::Vertex, corners[0]};

  HullFeature face{FeatureKind::Face, -1};
  for (const int edge : hull.around_vertex(corners[0])) {
    const int target = at(hull.half_edges, Hull<S>::twin(edge)).origin;
    if (corners.size() == 2 && target == corners[1]) return {FeatureKind::Edge, edge};
    const int left = at(hull.half_edges, edge).face;
    if (face.index < 0 && has_all(hull, left, corners)) face.index = left;
  }
  return face;
}

template <class S> int nearest_outside_edge(const Hull<S>& hull, int face, const Vec3<S>& point) {
  const Vec3<S>& normal = at(hull.planes, face).normal;
  int best = at(hull.face_edges, face);
  S farthest = S(0);  // squared
  for (const int edge : hull.around_face(face)) {
    const S outside = SidePlane<S>(hull, edge, normal).distance(point);  // times the edge's length
    const S squared_length = (hull.target(edge) - hull.origin(edge)).squaredNorm();
    if (outside > S(0) && outside * outside / squared_length > farthest) {
      farthest = outside * outside / squared_length;
      best = edge;
    }
  }
  return best;
}

template <class S>
bool projects_into(const Hull<S>& hull, int face, const Vec3<S>& point, S thickness) {
  const Vec3<S>& normal = at(hull.planes, face).normal;
  for (const int edge : hull.around_face(face)) {
    const SidePlane<S> side(hull, edge, normal);
    if (side.distance(point) > thickness * side.length) return false;
  }
  return true;
}

template <class S>
ClippedSegment<S> clip_to_prism(const Hull<S>& hull, int face, const Vec3<S> (&ends)[2],
                                S thickness) {
  const Vec3<S>& normal = at(hull.planes, face).normal;
  ClippedSegment<S> clipped;
  for (const int edge : hull.around_face(face)) {
    const SidePlane<S> side(hull, edge, normal);
    cut(side.distance(ends[0]), side.distance(ends[1]), thickness * side.length, edge, clipped);
    if (clipped.empty()) break;
  }
  return clipped;
}

template <class S>
ClippedSegment<S> clip_to_edge(const Hull<S>& hull, int half_edge, const Vec3<S> (&ends)[2]) {
  ClippedSegment<S> clipped;
  for (const int leaving : {half_edge, Hull<S>::twin(half_edge)}) {
    const Vec3<S>& vertex = hull.origin(leaving);
    const Vec3<S> outward = vertex - hull.target(leaving);
    cut(outward.dot(Vec3<S>(ends[0] - vertex)), outward.dot(Vec3<S>(ends[1] - vertex)), S(0),
        leaving, clipped);
  }
  return clipped;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(feature_of_b, nearest_outside_edge, projects_into, clip_to_prism,
                              clip_to_edge);

}  // namespace contactscope
