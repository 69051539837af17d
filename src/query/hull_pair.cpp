#include "query/hull_pair.h"

#include <algorithm>
#include <limits>

namespace contactscope {
namespace {

template <class S, int N>
void rotate(const Mat3<S>& rotation, VectorLanes<S, N>& vectors) {
  S* __restrict x = vectors.x();
  S* __restrict y = vectors.y();
  S* __restrict z = vectors.z();
  const S xx = rotation(0, 0), xy = rotation(0, 1), xz = rotation(0, 2);
  const S yx = rotation(1, 0), yy = rotation(1, 1), yz = rotation(1, 2);
  const S zx = rotation(2, 0), zy = rotation(2, 1), zz = rotation(2, 2);
  const int count = vectors.padded_count();
  for (int i = 0; i < count; ++i) {
    const S px = x[i], py = y[i], pz = z[i];
    x[i] = dot(xx, xy, xz, px, py, pz);
    y[i] = dot(yx, yy, yz, px, py, pz);
    z[i] = dot(zx, zy, zz, px, py, pz);
  }
}

template <class S, int N>
void translate(const Vec3<S>& by, VectorLanes<S, N>& points) {
  const int count = points.padded_count();
  for (int i = 0; i < count; ++i) points.x()[i] += by.x();
  for (int i = 0; i < count; ++i) points.y()[i] += by.y();
  for (int i = 0; i < count; ++i) points.z()[i] += by.z();
}

template <class S>
void gather(const Hull<S>& hull, PlacedHull<S>& placed) {
  const std::size_t vertex_count = hull.vertices.size();
  S* x = placed.vertices.x();
  S* y = placed.vertices.y();
  S* z = placed.vertices.z();
  for (std::size_t i = 0; i < vertex_count; ++i) {
    x[i] = hull.vertices[i].x();
    y[i] = hull.vertices[i].y();
    z[i] = hull.vertices[i].z();
  }
  placed.vertices.fill_padding(Vec3<S>::Zero());

  const std::size_t face_count = hull.planes.size();
  S* nx = placed.normals.x();
  S* ny = placed.normals.y();
  S* nz = placed.normals.z();
  S* offsets = placed.offsets.data();
  for (std::size_t i = 0; i < face_count; ++i) {
    nx[i] = hull.planes[i].normal.x();
    ny[i] = hull.planes[i].normal.y();
    nz[i] = hull.planes[i].normal.z();
    offsets[i] = hull.planes[i].offset;
  }
  placed.normals.fill_padding(Vec3<S>::Zero());
  // A padding face lies infinitely deep, so that no query picks it.
  for (int i = placed.normals.count(); i < placed.normals.padded_count(); ++i) {
    offsets[i] = std::numeric_limits<S>::infinity();
  }
}

}  // namespace

template <class S>
PlacedHull<S>::PlacedHull(const Hull<S>& placed)
    : hull(placed),
      rotation(Mat3<S>::Identity()),
      vertices(placed.vertex_count()),
      normals(placed.face_count()),
      offsets(padded(placed.face_count())) {
  gather(placed, *this);
}

template <class S>
PlacedHull<S>::PlacedHull(const Hull<S>& placed, const Mat3<S>& to_frame, const Vec3<S>& position)
    : hull(placed),
      rotation(to_frame),
      vertices(placed.vertex_count()),
      normals(placed.face_count()),
      offsets(padded(placed.face_count())) {
  gather(placed, *this);
  rotate(to_frame, vertices);
  translate(position, vertices);
  rotate(to_frame, normals);
  const int faces = normals.padded_count();
  for (int i = 0; i < faces; ++i) {
    offsets[i] += dot(normals.x()[i], normals.y()[i], normals.z()[i], position.x(), position.y(),
                      position.z());
  }
}

template <class S>
HullPair<S>::HullPair(const Hull<S>& hull_a, const Hull<S>& hull_b, const Pose<S>& b_in_a)
    : HullPair(hull_a, hull_b, b_in_a.rotation.toRotationMatrix(), b_in_a.position) {}

template <class S>
HullPair<S>::HullPair(const Hull<S>& hull_a, const Hull<S>& hull_b, const Mat3<S>& rotation,
                      const Vec3<S>& position)
    : a(hull_a),
      b(hull_b, rotation, position),
      scale(hull_a.centroid.norm() + hull_a.radius + hull_b.centroid.norm() + hull_b.radius +
            position.norm()),
      min_radius(std::min(hull_a.radius, hull_b.radius)) {}

template struct PlacedHull<float>;
template struct PlacedHull<double>;
template struct HullPair<float>;
template struct HullPair<double>;

}  // namespace contactscope
