#include "geometry/hull.h"

#include <cstddef>

namespace contactscope {

template <class T, class S>
Hull<T> hull_cast(const Hull<S>& hull) {
  Hull<T> cast;
  cast.vertices.reserve(hull.vertices.size());
  for (const Vec3<S>& vertex : hull.vertices) cast.vertices.push_back(vertex.template cast<T>());
  cast.half_edges = hull.half_edges;
  cast.vertex_edges = hull.vertex_edges;
  cast.face_edges = hull.face_edges;
  cast.planes.reserve(hull.planes.size());
  for (const Plane<S>& plane : hull.planes) cast.planes.push_back(plane.template cast<T>());
  cast.centroid = hull.centroid.template cast<T>();
  cast.radius = static_cast<T>(hull.radius);
  return cast;
}

template <class S>
int support_vertex(const Hull<S>& hull, const Vec3<S>& direction) {
  int best = 0;
  S best_distance = direction.dot(hull.vertices[0]);
  for (int i = 1; i < hull.vertex_count(); ++i) {
    const S distance = direction.dot(hull.vertices[static_cast<std::size_t>(i)]);
    if (distance > best_distance) {
      best_distance = distance;
      best = i;
    }
  }
  return best;
}

template <class S>
std::vector<int> face_vertices(const Hull<S>& hull, int face) {
  std::vector<int> vertices;
  const int first = hull.face_edges[static_cast<std::size_t>(face)];
  int half_edge = first;
  do {
    const HalfEdge& edge = hull.half_edges[static_cast<std::size_t>(half_edge)];
    vertices.push_back(edge.origin);
    half_edge = edge.next;
  } while (half_edge != first);
  return vertices;
}

template Hull<float> hull_cast<float, double>(const Hull<double>&);
template Hull<double> hull_cast<double, double>(const Hull<double>&);
template Hull<double> hull_cast<double, float>(const Hull<float>&);
template Hull<float> hull_cast<float, float>(const Hull<float>&);
template int support_vertex<float>(const Hull<float>&, const Vec3<float>&);
template int support_vertex<double>(const Hull<double>&, const Vec3<double>&);
template std::vector<int> face_vertices<float>(const Hull<float>&, int);
template std::vector<int> face_vertices<double>(const Hull<double>&, int);

}  // namespace contactscope
