#include "query/hull_pair.h"

#include <algorithm>

namespace contactscope {
namespace {

/// `to` = rotation * `from` + position, with the lanes of `to` after each other from there on.
template <class S>
void place(const VectorLanes<S>& from, const Mat3<S>& rotation, const Vec3<S>& position,
           S* __restrict to) {
  const S* __restrict x = from.x();
  const S* __restrict y = from.y();
  const S* __restrict z = from.z();
  const int count = from.padded_count();
  for (int row = 0; row < 3; ++row) {
    const S rx = rotation(row, 0), ry = rotation(row, 1), rz = rotation(row, 2);
    const S shift = position[row];
    for (int i = 0; i < count; ++i) to[i] = dot(rx, ry, rz, x[i], y[i], z[i]) + shift;
    to += count;
  }
}

/// Planes with rotated normals, moved by `position`.
template <class S>
void place_offsets(const VectorLanes<S>& normals, const S* __restrict from, const Vec3<S>& position,
                   S* __restrict to) {
  const S* __restrict nx = normals.x();
  const S* __restrict ny = normals.y();
  const S* __restrict nz = normals.z();
  const S x = position.x(), y = position.y(), z = position.z();
  const int count = normals.padded_count();
  for (int i = 0; i < count; ++i) to[i] = from[i] + dot(nx[i], ny[i], nz[i], x, y, z);
}

}  // namespace

template <class S>
PlacedHull<S>::PlacedHull(const Hull<S>& placed)
    : hull(placed),
      rotation(Mat3<S>::Identity()),
      vertices(placed.lanes.vertices.data(), placed.vertex_count()),
      normals(placed.lanes.normals.data(), placed.face_count()),
      offsets(placed.lanes.offsets.data()),
      placed_(0) {}

template <class S>
PlacedHull<S>::PlacedHull(const Hull<S>& placed, const Mat3<S>& to_frame, const Vec3<S>& position)
    : hull(placed),
      rotation(to_frame),
      vertices(nullptr, placed.vertex_count()),
      normals(nullptr, placed.face_count()),
      offsets(nullptr),
      placed_(3 * padded(placed.vertex_count()) + 4 * padded(placed.face_count())) {
  S* const placed_vertices = placed_.data();
  S* const placed_normals = placed_vertices + 3 * vertices.padded_count();
  S* const placed_offsets = placed_normals + 3 * normals.padded_count();
  place({placed.lanes.vertices.data(), vertices.count()}, to_frame, position, placed_vertices);
  place({placed.lanes.normals.data(), normals.count()}, to_frame, Vec3<S>(Vec3<S>::Zero()),
        placed_normals);
  vertices = {placed_vertices, vertices.count()};
  normals = {placed_normals, normals.count()};
  place_offsets(normals, placed.lanes.offsets.data(), position, placed_offsets);
  offsets = placed_offsets;
}

template <class S>
HullPair<S>::HullPair(const Hull<S>& hull_a, const Hull<S>& hull_b, const Pose<S>& b_in_a)
    : a(hull_a),
      b(hull_b, b_in_a.rotation.toRotationMatrix(), b_in_a.position),
      scale(hull_a.centroid.norm() + hull_a.radius + hull_b.centroid.norm() + hull_b.radius +
            b_in_a.position.norm()),
      min_radius(std::min(hull_a.radius, hull_b.radius)) {}

template struct PlacedHull<float>;
template struct PlacedHull<double>;
template struct HullPair<float>;
template struct HullPair<double>;

}  // namespace contactscope
