#pragma once

#include "manifold/contact_depth.h"
#include "manifold/fast/clip_rectangle.h"
#include "query/fast/box_edges.h"

/// The face contact of two boxes: the incident face at the support vertex, clipped against the
/// sides of the reference face. Bit for bit the result of create_face_contact() for any two hulls.
namespace contactscope::boxes {

/// Two rectangles clip to at most eight corners.
inline constexpr int kMaxPoints = 8;

/// In A's frame.
template <class S> struct BoxContact {
  AxisKind axis;
  ContactType type;
  int count = 0;
  Three<S> normal;  // unit, from A to B
  S scale;          // metres, as in Contact
  ContactPoint<S> points[kMaxPoints];

  /// `first` and `second` are indices into kEdgeRefs, in this order.
  [[gnu::always_inline]] void put(int place, const Three<S>& position, S separation, int first,
                                  int second);
};

/// The edges of both boxes in the order of ids, A's before B's, as words: reading a reference as
/// one word stalls if it was written as two bytes and an int.
inline constexpr std::array<std::uint64_t, 24> kEdgeRefs = [] {
  std::array<std::uint64_t, 24> refs{};
  for (int i = 0; i < 24; ++i) {
    const FeatureRef ref = edge_ref(i < 12 ? Owner::A : Owner::B, i % 12);
    struct Bytes {
      Owner owner;
      FeatureKind kind;
      std::uint8_t gap[2];
      std::uint32_t index;
    };
    refs[static_cast<std::size_t>(i)] =
        std::bit_cast<std::uint64_t>(Bytes{ref.owner, ref.kind, {}, ref.index});
  }
  return refs;
}();

/// A position and a separation in one pack.
template <class S>
[[gnu::always_inline]] inline Three<S> with_separation(const Three<S>& position,
                                                       const Three<S>& distance) {
  const Three<S> z = __builtin_shufflevector(position, distance, 2, 2, 7, 7);
  return __builtin_shufflevector(position, z, 0, 1, 4, 6);
}

template <class S>
[[gnu::always_inline]] inline void BoxContact<S>::put(int place, const Three<S>& position,
                                                      S separation, int first, int second) {
  static_assert(sizeof(ContactPoint<S>) == sizeof(Three<S>) + 16);
  // NOLINTNEXTLINE(modernize-use-using): GCC wants it so
  typedef std::uint64_t Words __attribute__((vector_size(16)));
  const Words id = {kEdgeRefs[static_cast<std::size_t>(first)],
                    kEdgeRefs[static_cast<std::size_t>(second)]};
  const Three<S> four = with_separation<S>(position, all_of<S>(separation));
  auto* const to = reinterpret_cast<std::byte*>(&points[place]);
  std::memcpy(to, &four, sizeof four);
  std::memcpy(to + sizeof four, &id, sizeof id);
}

/// ToWorld for packs, with the same bits.
template <class S> class PacksToWorld;
template <> class PacksToWorld<float> {
 public:
  [[gnu::always_inline]] explicit PacksToWorld(const Pose<float>& a)
      : columns_(lanes::rotation_columns(a.rotation)), position_(three(a.position)) {}
  [[gnu::always_inline]] Three<float> direction(const Three<float>& v) const {
    return columns_.of[0] * spread<0>(v) +
           (columns_.of[1] * spread<1>(v) + columns_.of[2] * spread<2>(v));
  }
  [[gnu::always_inline]] Three<float> point(const Three<float>& v) const {
    return direction(v) + position_;
  }

 private:
  Columns<float> columns_;
  Three<float> position_;
};
/// In double Eigen's matrix products may add by rows or by columns, so this calls Eigen.
template <> class PacksToWorld<double> {
 public:
  explicit PacksToWorld(const Pose<double>& a) : to_world_(a) {}
  Three<double> direction(const Three<double>& v) const {
    return three(to_world_.direction(vector<double>(v)));
  }
  Three<double> point(const Three<double>& v) const {
    return three(to_world_.point(vector<double>(v)));
  }

 private:
  ToWorld<double> to_world_;
};

/// finish_contact() without a record.
template <class S>
[[gnu::always_inline]] inline void finish(const Pose<S>& pose_a, const CollideOptions& options,
                                          BoxContact<S>& contact, Manifold<S>& manifold) {
  const PacksToWorld<S> to_world(pose_a);
  manifold.axis = contact.axis;
  manifold.type = contact.type;
  const Three<S> normal = to_world.direction(contact.normal);
  manifold.normal = vector<S>(normal);
  const bool few = contact.count <= options.reduction.max_points;
  // Zero times a finite number is zero; times any other it is NaN.
  Three<S> nothing = S(0) * three(manifold.normal);
  for (int i = 0; i < contact.count; ++i) {
    const Three<S> in_a = lanes::load_pack<Three<S>>(contact.points[i].position.data());
    const Three<S> four = with_separation<S>(to_world.point(in_a), in_a);
    nothing += S(0) * four;
    std::memcpy(static_cast<void*>(&contact.points[i]), &four, sizeof four);
  }
  const ContactPoints<S> points(contact.points, static_cast<std::size_t>(contact.count));
  const bool finite = lane_bits<S>(nothing == Three<S>{}) == 0xfU;
  if (options.reducer == nullptr || (few && finite)) {
    for (const ContactPoint<S>& point : points) manifold.points.push_back(point);
    return;
  }
  const ReduceOptions reduction = options.reduction_at(contact.scale);
  for (const int index : reduce(options.reducer, points, manifold.normal, reduction))
    manifold.points.push_back(at(points, index));
}

/// The vertex of a box that is deepest below a plane.
template <class S> struct Support {
  int vertex;     // the earliest among equals
  S least;        // its distance, metres
  bool is_alone;  // the others are farther by more than the slack
};
template <class S>
[[gnu::always_inline]] inline Support<S> support_below(const Three<S>& low, const Three<S>& high,
                                                       S slack) {
  const Three<S> least = lanes::smallest<S>(lanes::smaller(low, high));
  const auto below = [&](const Three<S>& bound) __attribute__((always_inline)) {
    return lane_bits<S>(low <= bound) | lane_bits<S>(high <= bound) << 4;
  };
  const std::uint32_t near = below(least + slack);
  return {std::countr_zero(below(least) | 0x100U), least[0], (near & (near - 1)) == 0};
}

template <class S> struct FacePair {
  Plane<S> plane;         // of the reference face, A's frame
  int incident;           // face of the other box
  Support<S> separation;  // of the other box from the plane
};

/// The eight sums of x, y and z with signs, in the order of a box's vertices, in two packs.
template <class S> struct EightSums {
  [[gnu::always_inline]] EightSums(S x, S y, S z) {
    const Three<S> low = Three<S>{-x, x, -x, x} + Three<S>{-y, -y, y, y};
    of[0] = low - z;
    of[1] = low + z;
  }
  Three<S> of[2];
};

/// See incident_face(). `along`: cosines of the reference normal with the other box's axes.
template <class S>
[[gnu::always_inline]] inline int incident_at(int support, const Vec3<S>& along) {
  int best = 0;
  S least = std::numeric_limits<S>::infinity();
  for (const int face : kBox.faces_around[static_cast<std::size_t>(support & 7)]) {
    const S cosine = face % 2 == 0 ? along[face / 2] : -along[face / 2];
    best = cosine < least ? face : best;
    least = cosine < least ? cosine : least;
  }
  return best;
}

/// Constants of a face's side planes for any box: a lane per side, in the order of the ring.
template <class S> struct FaceSides {
  std::array<S, 4> x{}, y{}, z{};  // of the normals, in the box's own frame
  int axes[2] = {};                // axes of edges 0 and 1 of the ring; 2 and 3 run back along them
  std::array<S, 4> up{};           // edge direction along its axis: 1 or -1
};
template <class S>
inline constexpr std::array<FaceSides<S>, 6> kFaceSides = [] {
  std::array<FaceSides<S>, 6> sides;
  for (std::size_t face = 0; face < 6; ++face) {
    FaceSides<S>& of = sides[face];
    for (std::size_t i = 0; i < 4; ++i) {
      const int edge = kBox.face_ring[face][i];
      const int side = kBox.face(edge ^ 1);
      (side / 2 == 0 ? of.x : side / 2 == 1 ? of.y : of.z)[i] = side % 2 == 0 ? S(1) : S(-1);
      const int from = kBox.origin(edge), to = kBox.origin(edge ^ 1);
      of.axes[i % 2] = (from ^ to) / 2;
      of.up[i] = to > from ? S(1) : S(-1);
    }
  }
  return sides;
}();

constexpr const std::array<int, 4>& ring_of(int face) {
  return kBox.face_ring[static_cast<std::size_t>(face)];
}

/// The corners of a face in the order of its ring.
template <class Vertices, class P>
[[gnu::always_inline]] inline void lay_corners(const Vertices& vertices, int face,
                                               P (&corners)[4]) {
  const std::array<int, 4>& ring = ring_of(face);
  for (std::size_t i = 0; i < 4; ++i) corners[i] = vertices[kBox.origin(ring[i])];
}

/// The side planes of a face of a box about the origin: faces of the box itself.
template <class S>
[[gnu::always_inline]] inline void lay_sides(const Three<S>& half, int face,
                                             RectanglePair<S>& rectangles) {
  const FaceSides<S>& sides = kFaceSides<S>[static_cast<std::size_t>(face)];
  rectangles.side_x = lanes::load_pack<Three<S>>(sides.x.data());
  rectangles.side_y = lanes::load_pack<Three<S>>(sides.y.data());
  rectangles.side_z = lanes::load_pack<Three<S>>(sides.z.data());
  rectangles.side_offset = absolute<S>(rectangles.side_x) * half[0] +
                           absolute<S>(rectangles.side_y) * half[1] +
                           absolute<S>(rectangles.side_z) * half[2];
}

/// Reference face of A.
template <class S>
[[gnu::always_inline]] inline FacePair<S> face_of_a(const BoxPair<S>& pair, int face, S slack,
                                                    RectanglePair<S>& rectangles) {
  const int axis = face / 2;
  const S sign = face % 2 == 0 ? S(1) : S(-1);
  FacePair<S> result;
  const Vec3<S>& half = pair.a.half_extents;
  const EightSums<S> along(pair.arms.of[0][axis], pair.arms.of[1][axis], pair.arms.of[2][axis]);
  const S shift = pair.position[axis];
  result.separation = support_below<S>(sign * (along.of[0] + shift) - half[axis],
                                       sign * (along.of[1] + shift) - half[axis], slack);
  const Vec3<S> cosines = vector<S>(sign * pair.rows.of[axis]);
  result.incident = incident_at<S>(result.separation.vertex, cosines);
  result.plane.normal = Vec3<S>::Unit(axis) * sign;
  result.plane.offset = half[axis];
  lay_corners(VerticesOfB<S>(pair), result.incident, rectangles.corners);
  lay_sides(three(half), face, rectangles);
  return result;
}

/// Reference face of B: computes its side planes as side_plane() does.
template <class S>
[[gnu::always_inline]] inline FacePair<S> face_of_b(const BoxPair<S>& pair,
                                                    const Columns<S>& directions, int face, S slack,
                                                    RectanglePair<S>& rectangles) {
  const int axis = face / 2;
  const S sign = face % 2 == 0 ? S(1) : S(-1);
  const Vec3<S> cosines = vector<S>(sign * pair.columns.of[axis]);
  FacePair<S> result;
  const Vec3<S> n = cosines;  // A's axes are the frame's
  result.plane.normal = n;
  const Vec3<S>& p = pair.position;
  result.plane.offset =
      pair.b.half_extents[axis] + contactscope::dot(n.x(), n.y(), n.z(), p.x(), p.y(), p.z());
  const Vec3<S>& half = pair.a.half_extents;
  const EightSums<S> along(n.x() * half.x(), n.y() * half.y(), n.z() * half.z());
  const S offset = result.plane.offset;
  result.separation = support_below<S>(along.of[0] - offset, along.of[1] - offset, slack);
  result.incident = incident_at<S>(result.separation.vertex, cosines);
  lay_corners(VerticesOfA<S>(pair), result.incident, rectangles.corners);

  // Opposite sides have opposite normals.
  const FaceSides<S>& sides = kFaceSides<S>[static_cast<std::size_t>(face)];
  const Vec3<S> even = vector<S>(directions.of[sides.axes[0]]).cross(n);
  const Vec3<S> odd = vector<S>(directions.of[sides.axes[1]]).cross(n);
  const Three<S> up = lanes::load_pack<Three<S>>(sides.up.data());
  rectangles.side_x = up * Three<S>{even.x(), odd.x(), even.x(), odd.x()};
  rectangles.side_y = up * Three<S>{even.y(), odd.y(), even.y(), odd.y()};
  rectangles.side_z = up * Three<S>{even.z(), odd.z(), even.z(), odd.z()};
  Three<S> o[4];
  lay_corners(VerticesOfB<S>(pair), face, o);
  rectangles.side_offset =
      dot_sum<S>(Three<S>(rectangles.side_x * Three<S>{o[0][0], o[1][0], o[2][0], o[3][0]}),
                 Three<S>(rectangles.side_y * Three<S>{o[0][1], o[1][1], o[2][1], o[3][1]}),
                 Three<S>(rectangles.side_z * Three<S>{o[0][2], o[1][2], o[2][2], o[3][2]}));
  return result;
}

/// The edges of each face's ring, as indices into kEdgeRefs: A's faces, then B's.
inline constexpr std::array<std::array<std::uint8_t, 4>, 12> kRingEdges = [] {
  std::array<std::array<std::uint8_t, 4>, 12> edges{};
  for (std::size_t face = 0; face < 12; ++face)
    for (std::size_t i = 0; i < 4; ++i)
      edges[face][i] =
          static_cast<std::uint8_t>(kBox.face_ring[face % 6][i] / 2 + (face < 6 ? 0 : 12));
  return edges;
}();

/// The faces of a face contact. `directions` are those of B's axes, see BoxPair. The result reports
/// whether another vertex is as deep as the support within `slack` (metres).
template <class S>
[[gnu::always_inline]] inline FacePair<S> face_pair(const BoxPair<S>& pair, Owner reference,
                                                    int face, const Columns<S>& directions, S slack,
                                                    RectanglePair<S>& rectangles) {
  rectangles.thickness = clip_thickness(pair.scale);
  return reference == Owner::A ? face_of_a(pair, face, slack, rectangles)
                               : face_of_b(pair, directions, face, slack, rectangles);
}

/// create_face_contact() for two boxes. Returns false where the caller must use that instead.
template <class S>
[[gnu::always_inline]] inline bool face_contact(const FacePair<S>& faces, Owner owner, int face,
                                                const RectanglePair<S>& rectangles, S scale,
                                                S margin, BoxContact<S>& contact, S& deepest) {
  ClippedRectangle<S> clipped;
  if (!clip_rectangle(rectangles, clipped)) [[unlikely]]
    return false;

  const bool of_a = owner == Owner::A;
  // Indices into kEdgeRefs of the edges that ClippedRectangle counts.
  std::array<std::uint8_t, 8> edges;
  const int incident = faces.incident + (of_a ? 6 : 0), reference = face + (of_a ? 0 : 6);
  std::memcpy(edges.data(), &kRingEdges[static_cast<std::size_t>(incident)], 4);
  std::memcpy(edges.data() + 4, &kRingEdges[static_cast<std::size_t>(reference)], 4);
  contact.axis = of_a ? AxisKind::FaceA : AxisKind::FaceB;
  const Three<S> normal = three(faces.plane.normal);
  contact.normal = of_a ? normal : -normal;
  deepest = std::numeric_limits<S>::infinity();
  const S highest = highest_kept(margin, scale);
  std::uint64_t list = clipped.list;
  int count = 0;
  for (int i = 0; i < clipped.count; ++i, list >>= 8) {
    const std::size_t place = list & 15U;
    const Three<S>& position = clipped.positions[place];
    const S distance = dot<S>(normal, position) - faces.plane.offset;
    const bool is_kept = distance <= highest;
    const S separation = std::min(distance, margin);
    const unsigned crossing = clipped.crossings[place];
    const std::uint8_t one = edges[crossing & 7U], two = edges[crossing >> 4];
    contact.put(count, position - distance * normal, separation, std::min(one, two),
                std::max(one, two));
    count += is_kept ? 1 : 0;  // else the next point replaces it; no branch to mispredict
    deepest = is_kept && separation < deepest ? separation : deepest;
  }
  contact.count = count;
  contact.type = face_contact_type(static_cast<std::size_t>(contact.count));
  return true;
}

}  // namespace contactscope::boxes
