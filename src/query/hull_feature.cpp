#include "query/hull_feature.h"

namespace contactscope {
namespace {

struct Corners {
  int vertices[4];
  int count = 0;

  bool has(int vertex) const {
    for (int i = 0; i < count; ++i) {
      if (vertices[i] == vertex) return true;
    }
    return false;
  }
};

template <class S>
bool has_all(const Hull<S>& hull, int face, const Corners& corners) {
  int found = 0;
  const int first = hull.face_edges[static_cast<std::size_t>(face)];
  int edge = first;
  do {
    const HalfEdge& half_edge = hull.half_edges[static_cast<std::size_t>(edge)];
    found += corners.has(half_edge.origin) ? 1 : 0;
    edge = half_edge.next;
  } while (edge != first);
  return found == corners.count;
}

}  // namespace

template <class S>
HullFeature feature_of_b(const Hull<S>& hull, const GjkSimplex<S>& simplex) {
  Corners corners;
  for (const GjkVertex<S>& vertex : simplex.vertices) {
    if (!corners.has(vertex.index_b)) corners.vertices[corners.count++] = vertex.index_b;
  }
  if (corners.count == 1) return {FeatureKind::Vertex, corners.vertices[0]};

  HullFeature face{FeatureKind::Face, -1};
  const int first = hull.vertex_edges[static_cast<std::size_t>(corners.vertices[0])];
  int edge = first;
  do {
    const HalfEdge& half_edge = hull.half_edges[static_cast<std::size_t>(edge)];
    const HalfEdge& twin = hull.half_edges[static_cast<std::size_t>(Hull<S>::twin(edge))];
    if (corners.count == 2 && twin.origin == corners.vertices[1]) return {FeatureKind::Edge, edge};
    if (face.index < 0 && has_all(hull, half_edge.face, corners)) face.index = half_edge.face;
    edge = twin.next;
  } while (edge != first);
  return face;
}

template <class S>
int edge_beside(const Hull<S>& hull, int face, const Vec3<S>& point) {
  const Vec3<S>& normal = hull.planes[static_cast<std::size_t>(face)].normal;
  const int first = hull.face_edges[static_cast<std::size_t>(face)];
  int best = first;
  S farthest = S(0);  // squared
  int edge = first;
  do {
    const Vec3<S>& origin = hull.origin(edge);
    const Vec3<S> along = hull.target(edge) - origin;
    const S outside = along.cross(normal).dot(point - origin);  // times the edge's length
    const S squared = outside * outside / along.squaredNorm();
    if (outside > S(0) && squared > farthest) {
      farthest = squared;
      best = edge;
    }
    edge = hull.half_edges[static_cast<std::size_t>(edge)].next;
  } while (edge != first);
  return best;
}

template HullFeature feature_of_b(const Hull<float>&, const GjkSimplex<float>&);
template HullFeature feature_of_b(const Hull<double>&, const GjkSimplex<double>&);
template int edge_beside(const Hull<float>&, int, const Vec3<float>&);
template int edge_beside(const Hull<double>&, int, const Vec3<double>&);

}  // namespace contactscope
