#include "geometry/hull.h"

#include "geometry/box_topology.h"
#include "geometry/lanes.h"

namespace contactscope {
namespace {

/// Number of elements in the lanes of `count` vectors.
std::size_t lane_count(int count) { return static_cast<std::size_t>(3 * padded(count)); }

template <class S> void put(std::vector<S>& lanes, std::size_t i, const Vec3<S>& vector) {
  const std::size_t stride = lanes.size() / 3;
  for (std::size_t k = 0; k < 3; ++k) lanes[k * stride + i] = vector[static_cast<int>(k)];
}

/// Half extents of a box that equals the result of make_box in every number, else zero; zero also
/// if squared lengths would leave the range of S.
template <class S> Vec3<S> box_extents(const Hull<S>& hull) {
  const Vec3<S> none = Vec3<S>::Zero();
  const auto same = [](const HalfEdge& one, const HalfEdge& other) {
    return one.origin == other.origin && one.next == other.next && one.face == other.face;
  };
  if (hull.vertex_count() != 8 || hull.face_count() != 6 || hull.centroid != none ||
      !std::ranges::equal(hull.half_edges, kBox.half_edges, same) ||
      !std::ranges::equal(hull.face_edges, kBox.face_edges) ||
      !std::ranges::equal(hull.vertex_edges, kBox.vertex_edges))
    return none;
  const Vec3<S>& half = hull.vertices[7];
  const S least = std::sqrt(std::numeric_limits<S>::min()), most = S(1) / least;
  if (!(half.minCoeff() > least && half.maxCoeff() < most)) return none;
  for (int i = 0; i < 8; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const S sign = (i >> axis & 1) != 0 ? S(1) : S(-1);
      if (at(hull.vertices, i)[axis] != sign * half[axis]) return none;
    }
  }
  for (int face = 0; face < 6; ++face) {
    const Plane<S>& plane = at(hull.planes, face);
    const Vec3<S> normal = Vec3<S>::Unit(face / 2) * S(1 - 2 * (face % 2));
    if (plane.normal != normal || plane.offset != half[face / 2]) return none;
  }
  return half;
}

}  // namespace

template <class S> void lay_out(Hull<S>& hull) {
  hull.half_extents = box_extents(hull);
  hull.lanes.vertices.assign(lane_count(hull.vertex_count()), S(0));
  for (std::size_t i = 0; i < hull.vertices.size(); ++i)
    put(hull.lanes.vertices, i, hull.vertices[i]);
  hull.lanes.normals.assign(lane_count(hull.face_count()), S(0));
  hull.lanes.offsets.assign(hull.lanes.normals.size() / 3, std::numeric_limits<S>::infinity());
  for (std::size_t i = 0; i < hull.planes.size(); ++i) {
    put(hull.lanes.normals, i, hull.planes[i].normal);
    hull.lanes.offsets[i] = hull.planes[i].offset;
  }
}

template <class T, class S> Hull<T> hull_cast(const Hull<S>& hull) {
  Hull<T> cast{
      .vertices = cast_each<Vec3<T>>(hull.vertices),
      .half_edges = hull.half_edges,
      .vertex_edges = hull.vertex_edges,
      .face_edges = hull.face_edges,
      .planes = mapped(hull.planes, [](const Plane<S>& plane) { return plane.template cast<T>(); }),
      .lanes = {},
      .centroid = hull.centroid.template cast<T>(),
      .radius = static_cast<T>(hull.radius),
      .half_extents = Vec3<T>::Zero(),
      .seams = {hull.seams.covered, cast_each<Vec3<T>>(hull.seams.beyond)}};
  lay_out(cast);
  return cast;
}

template <class S> std::vector<int> face_vertices(const Hull<S>& hull, int face) {
  std::vector<int> vertices;
  for (const int edge : hull.around_face(face))
    vertices.push_back(at(hull.half_edges, edge).origin);
  return vertices;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(lay_out, face_vertices);
template Hull<float> hull_cast<float, double>(const Hull<double>&);
template Hull<double> hull_cast<double, double>(const Hull<double>&);
template Hull<double> hull_cast<double, float>(const Hull<float>&);
template Hull<float> hull_cast<float, float>(const Hull<float>&);

}  // namespace contactscope
