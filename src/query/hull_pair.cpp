#include "query/hull_pair.h"

#include "core/pack.h"

namespace contactscope {
namespace {

/// A matrix with each of its numbers broadcast to a pack.
template <class S> struct PackedRotation {
  using Pack = lanes::Pack<S>;

  explicit PackedRotation(const Mat3<S>& rotation) {
    for (int k = 0; k < 9; ++k) numbers[k] = lanes::all(rotation(k / 3, k % 3));
  }
  /// Component `row` of the rotated vectors (x, y, z).
  Pack turned(int row, const Pack& x, const Pack& y, const Pack& z) const {
    const Pack* const r = numbers + 3 * row;
    return (r[0] * x + r[1] * y) + r[2] * z;
  }

  Pack numbers[9];
};

/// `to` = rotation * `from` + position; `to` has the same lane layout as `from`.
template <class S>
void place_points(const VectorLanes<S>& from, const PackedRotation<S>& rotation,
                  const Vec3<S>& position, S* to) {
  using lanes::load;
  using lanes::Pack;
  const int count = from.padded_count();
  const Pack<S> shift[3] = {lanes::all(position.x()), lanes::all(position.y()),
                            lanes::all(position.z())};
  for (int i = 0; i < count; i += lanes::kWidth<S>) {
    const Pack<S> x = load(from.x() + i), y = load(from.y() + i), z = load(from.z() + i);
    for (int row = 0; row < 3; ++row)
      lanes::store<S>(rotation.turned(row, x, y, z) + shift[row], to + row * count + i);
  }
}

/// Places normals by rotation plus zero, and offsets by a shift by `position`.
template <class S>
void place_planes(const VectorLanes<S>& from, const S* offsets, const PackedRotation<S>& rotation,
                  const Vec3<S>& position, S* to, S* to_offsets) {
  using lanes::all;
  using lanes::load;
  using lanes::Pack;
  const int count = from.padded_count();
  const Pack<S> px = all(position.x()), py = all(position.y()), pz = all(position.z());
  for (int i = 0; i < count; i += lanes::kWidth<S>) {
    const Pack<S> x = load(from.x() + i), y = load(from.y() + i), z = load(from.z() + i);
    Pack<S> n[3];
    for (int row = 0; row < 3; ++row) {
      n[row] = rotation.turned(row, x, y, z) + all(S(0));
      lanes::store<S>(n[row], to + row * count + i);
    }
    const Pack<S> offset = load(offsets + i) + ((n[0] * px + n[1] * py) + n[2] * pz);
    lanes::store<S>(offset, to_offsets + i);
  }
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
  const PackedRotation<S> turn(to_frame);
  place_points({placed.lanes.vertices.data(), vertices.count()}, turn, position, placed_vertices);
  place_planes({placed.lanes.normals.data(), normals.count()}, placed.lanes.offsets.data(), turn,
               position, placed_normals, placed_offsets);
  vertices = {placed_vertices, vertices.count()};
  normals = {placed_normals, normals.count()};
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
