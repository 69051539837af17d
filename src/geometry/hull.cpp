#include "geometry/hull.h"

#include <limits>

#include "geometry/lanes.h"

namespace contactscope {
namespace {

/// Elements of the lanes of `count` vectors.
std::size_t lane_count(int count) {
  return static_cast<std::size_t>(3 * padded(count));
}

template <class S>
void put(std::vector<S>& lanes, std::size_t i, const Vec3<S>& vector) {
  const std::size_t stride = lanes.size() / 3;
  for (std::size_t k = 0; k < 3; ++k) lanes[k * stride + i] = vector[static_cast<int>(k)];
}

}  // namespace

template <class S>
void lay_out(Hull<S>& hull) {
  hull.lanes.vertices.assign(lane_count(hull.vertex_count()), S(0));
  for (std::size_t i = 0; i < hull.vertices.size(); ++i) {
    put(hull.lanes.vertices, i, hull.vertices[i]);
  }
  hull.lanes.normals.assign(lane_count(hull.face_count()), S(0));
  hull.lanes.offsets.assign(hull.lanes.normals.size() / 3, std::numeric_limits<S>::infinity());
  for (std::size_t i = 0; i < hull.planes.size(); ++i) {
    put(hull.lanes.normals, i, hull.planes[i].normal);
    hull.lanes.offsets[i] = hull.planes[i].offset;
  }
}

template <class T, class S>
Hull<T> hull_cast(const Hull<S>& hull) {
  Hull<T> cast{
      .vertices = cast_each<Vec3<T>>(hull.vertices),
      .half_edges = hull.half_edges,
      .vertex_edges = hull.vertex_edges,
      .face_edges = hull.face_edges,
      .planes = mapped(hull.planes, [](const Plane<S>& plane) { return plane.template cast<T>(); }),
      .lanes = {},
      .centroid = hull.centroid.template cast<T>(),
      .radius = static_cast<T>(hull.radius)};
  lay_out(cast);
  return cast;
}

template <class S>
std::vector<int> face_vertices(const Hull<S>& hull, int face) {
  std::vector<int> vertices;
  for (const int edge : hull.around_face(face))
    vertices.push_back(at(hull.half_edges, edge).origin);
  return vertices;
}

template void lay_out(Hull<float>&);
template void lay_out(Hull<double>&);
template Hull<float> hull_cast<float, double>(const Hull<double>&);
template Hull<double> hull_cast<double, double>(const Hull<double>&);
template Hull<double> hull_cast<double, float>(const Hull<float>&);
template Hull<float> hull_cast<float, float>(const Hull<float>&);
template std::vector<int> face_vertices<float>(const Hull<float>&, int);
template std::vector<int> face_vertices<double>(const Hull<double>&, int);

}  // namespace contactscope
