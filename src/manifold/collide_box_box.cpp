#include "manifold/collide_box_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "manifold/box_contact.h"
#include "manifold/clip_rectangle.h"
#include "query/box_sat.h"

namespace contactscope {
namespace {

using boxes::BoxAxis;
using boxes::BoxContact;
using boxes::BoxPair;
using boxes::Columns;
using boxes::RectanglePair;
using boxes::Three;
using boxes::Verdict;

/// A face of one box and the face of the other that is clipped against it.
template <class S>
struct FacePair {
  Plane<S> plane;  // of the reference face, A's frame
  int incident;    // face of the other box
};

/// The eight sums of x, y and z with signs, in the order of a box's vertices, in two packs.
template <class S>
struct EightSums {
  [[gnu::always_inline]] EightSums(S x, S y, S z) {
    const Three<S> low = Three<S>{-x, x, -x, x} + Three<S>{-y, -y, y, y};
    of[0] = low - z;
    of[1] = low + z;
  }
  Three<S> of[2];
};

/// The vertex of eight with the least value, the earliest of equals.
template <class S>
[[gnu::always_inline]] inline int earliest_least(const Three<S>& low, const Three<S>& high) {
  const Three<S> least = lanes::smallest<S>(lanes::smaller(low, high));
  return std::countr_zero(boxes::lane_bits<S>(low == least) |
                          boxes::lane_bits<S>(high == least) << 4 | 0x100U);
}

/// The incident face at the support vertex, see incident_face(). `along` has the cosines of the
/// reference normal with the axes of the other box.
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

/// What is known of a face's side planes before its box is: a lane for each, in the order of the ring.
template <class S>
struct FaceSides {
  std::array<S, 4> x{}, y{}, z{};  // of the normals, in the box's own frame
  int axes[2] = {};                // along which edges 0 and 1 of the ring run, and 2 and 3 back
  std::array<S, 4> up{};           // whether an edge runs up or down its axis: 1 or -1
};
template <class S>
constexpr std::array<FaceSides<S>, 6> kFaceSides = [] {
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

/// Reference face of A: the side planes are faces of A, and every number of theirs is known.
template <class S>
[[gnu::always_inline]] inline FacePair<S> face_of_a(const BoxPair<S>& pair, int face,
                                                    RectanglePair<S>& rectangles) {
  const int axis = face / 2;
  const S sign = face % 2 == 0 ? S(1) : S(-1);
  const Vec3<S>& half = pair.a.half_extents;
  const EightSums<S> along(pair.arms.of[0][axis], pair.arms.of[1][axis], pair.arms.of[2][axis]);
  const S shift = pair.position[axis];
  const int support = earliest_least<S>(sign * (along.of[0] + shift) - half[axis],
                                        sign * (along.of[1] + shift) - half[axis]);
  const Vec3<S> cosines = boxes::vector<S>(sign * pair.rows.of[axis]);
  FacePair<S> result;
  result.incident = incident_at<S>(support, cosines);
  result.plane.normal = Vec3<S>::Unit(axis) * sign;
  result.plane.offset = half[axis];
  lay_corners(boxes::VerticesOfB<S>(pair), result.incident, rectangles.corners);
  const FaceSides<S>& sides = kFaceSides<S>[static_cast<std::size_t>(face)];
  rectangles.side_x = lanes::load_pack<Three<S>>(sides.x.data());
  rectangles.side_y = lanes::load_pack<Three<S>>(sides.y.data());
  rectangles.side_z = lanes::load_pack<Three<S>>(sides.z.data());
  rectangles.side_offset = boxes::absolute<S>(rectangles.side_x) * half.x() +
                           boxes::absolute<S>(rectangles.side_y) * half.y() +
                           boxes::absolute<S>(rectangles.side_z) * half.z();
  return result;
}

/// Reference face of B: its side planes as side_plane() makes them.
template <class S>
[[gnu::always_inline]] inline FacePair<S> face_of_b(const BoxPair<S>& pair,
                                                    const Columns<S>& directions, int face,
                                                    RectanglePair<S>& rectangles) {
  const int axis = face / 2;
  const S sign = face % 2 == 0 ? S(1) : S(-1);
  const Vec3<S> cosines = boxes::vector<S>(sign * pair.columns.of[axis]);
  FacePair<S> result;
  const Vec3<S> n = cosines;  // the axes of A are those of the frame
  result.plane.normal = n;
  const Vec3<S>& p = pair.position;
  result.plane.offset = pair.b.half_extents[axis] + dot(n.x(), n.y(), n.z(), p.x(), p.y(), p.z());
  const Vec3<S>& half = pair.a.half_extents;
  const EightSums<S> along(n.x() * half.x(), n.y() * half.y(), n.z() * half.z());
  const S offset = result.plane.offset;
  const int support = earliest_least<S>(along.of[0] - offset, along.of[1] - offset);
  result.incident = incident_at<S>(support, cosines);
  lay_corners(boxes::VerticesOfA<S>(pair), result.incident, rectangles.corners);

  // Opposite sides have opposite normals.
  const FaceSides<S>& sides = kFaceSides<S>[static_cast<std::size_t>(face)];
  const Vec3<S> even = boxes::vector<S>(directions.of[sides.axes[0]]).cross(n);
  const Vec3<S> odd = boxes::vector<S>(directions.of[sides.axes[1]]).cross(n);
  const Three<S> up = lanes::load_pack<Three<S>>(sides.up.data());
  rectangles.side_x = up * Three<S>{even.x(), odd.x(), even.x(), odd.x()};
  rectangles.side_y = up * Three<S>{even.y(), odd.y(), even.y(), odd.y()};
  rectangles.side_z = up * Three<S>{even.z(), odd.z(), even.z(), odd.z()};
  Three<S> o[4];
  lay_corners(boxes::VerticesOfB<S>(pair), face, o);
  rectangles.side_offset =
      dot_sum<S>(Three<S>(rectangles.side_x * Three<S>{o[0][0], o[1][0], o[2][0], o[3][0]}),
                 Three<S>(rectangles.side_y * Three<S>{o[0][1], o[1][1], o[2][1], o[3][1]}),
                 Three<S>(rectangles.side_z * Three<S>{o[0][2], o[1][2], o[2][2], o[3][2]}));
  return result;
}

/// Of each face the edges of its ring, as places in kEdgeRefs: of A's faces, then of B's.
constexpr std::array<std::array<std::uint8_t, 4>, 12> kRingEdges = [] {
  std::array<std::array<std::uint8_t, 4>, 12> edges{};
  for (std::size_t face = 0; face < 12; ++face) {
    for (std::size_t i = 0; i < 4; ++i)
      edges[face][i] =
          static_cast<std::uint8_t>(kBox.face_ring[face % 6][i] / 2 + (face < 6 ? 0 : 12));
  }
  return edges;
}();

/// create_face_contact() for two boxes. False where it is to be asked.
template <class S>
[[gnu::always_inline]] inline bool face_contact(const BoxPair<S>& pair, const BoxAxis<S>& axis,
                                                S margin, BoxContact<S>& contact, S& deepest) {
  RectanglePair<S> rectangles;
  rectangles.thickness = clip_thickness(pair.scale);
  const bool of_a = axis.reference == Owner::A;
  const FacePair<S> faces = of_a ? face_of_a(pair, axis.face.face, rectangles)
                                 : face_of_b(pair, axis.directions, axis.face.face, rectangles);
  boxes::ClippedRectangle<S> clipped;
  if (!boxes::clip_rectangle(rectangles, clipped)) [[unlikely]]
    return false;

  // Places in kEdgeRefs of the edges that ClippedRectangle counts.
  std::array<std::uint8_t, 8> edges;
  const int incident = faces.incident + (of_a ? 6 : 0), reference = axis.face.face + (of_a ? 0 : 6);
  std::memcpy(edges.data(), &kRingEdges[static_cast<std::size_t>(incident)], 4);
  std::memcpy(edges.data() + 4, &kRingEdges[static_cast<std::size_t>(reference)], 4);
  contact.axis = of_a ? AxisKind::FaceA : AxisKind::FaceB;
  const Three<S> normal = boxes::three(faces.plane.normal);
  contact.normal = of_a ? normal : -normal;
  deepest = std::numeric_limits<S>::infinity();
  std::uint64_t list = clipped.list;
  for (int i = 0; i < clipped.count; ++i, list >>= 8) {
    const std::size_t place = list & 15U;
    const Three<S>& position = clipped.positions[place];
    const S separation = boxes::dot<S>(normal, position) - faces.plane.offset;
    if (!(separation <= margin)) continue;
    const unsigned crossing = clipped.crossings[place];
    const std::uint8_t one = edges[crossing & 7U], two = edges[crossing >> 4];
    contact.put(position - separation * normal, separation, std::min(one, two), std::max(one, two));
    deepest = separation < deepest ? separation : deepest;
  }
  contact.type = face_contact_type(static_cast<std::size_t>(contact.count));
  return true;
}

/// create_edge_contact() for two boxes.
template <class S>
[[gnu::always_inline]] inline void edge_contact(const BoxAxis<S>& axis, BoxContact<S>& contact) {
  contact.axis = AxisKind::EdgeEdge;
  contact.type = ContactType::EdgeEdge;
  contact.normal = axis.edge.normal;
  contact.put(axis.edge.middle, axis.edge.separation, axis.edges.edge_a / 2,
              12 + axis.edges.edge_b / 2);
}

/// As collide_hull_hull(), in the same steps. False where that is to be asked; what is in `contact` then
/// means nothing.
template <class S>
[[gnu::always_inline]] inline bool collide(const Hull<S>& a, const Hull<S>& b,
                                           const Pose<S>& b_in_a, const CollideOptions& options,
                                           BoxContact<S>& contact) {
  // A rotation that is none, or not finite.
  if (!(std::abs(b_in_a.rotation.squaredNorm() - S(1)) <= S(8) * std::numeric_limits<S>::epsilon()))
    return false;
  const BoxPair<S> pair(a, b, b_in_a);
  const S margin = static_cast<S>(options.margin);
  const BoxAxis<S> axis = boxes::box_sat(pair, margin, options.preference);
  if (axis.verdict == Verdict::Separated) return true;
  if (axis.verdict == Verdict::Undecided) return false;
  if (axis.verdict == Verdict::Edge) {
    edge_contact(axis, contact);
    return true;
  }
  S deepest;
  if (!face_contact(pair, axis, margin, contact, deepest)) return false;
  // As in create_contact(). Where the contact is not as deep as the axis, that takes another.
  if (axis.deepest > S(0)) return true;
  const S preferred = options.preference == Preference::Relative
                          ? preference_tolerance(axis.deepest, pair.min_radius)
                          : S(0);
  return deepest <= axis.deepest + preferred + depth_rounding(pair.scale);
}

}  // namespace

template <class S>
[[gnu::flatten]] bool collide_box_box(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                                      const Pose<S>& pose_b, const CollideOptions& options,
                                      std::vector<Manifold<S>>& manifolds) {
  BoxContact<S> contact;
  if (!collide(a, b, relative_pose(pose_a, pose_b), options, contact)) return false;
  if (contact.count > 0) boxes::finish(pose_a, options, contact, manifolds.emplace_back());
  return true;
}

template decltype(collide_box_box<float>) collide_box_box<float>;
template decltype(collide_box_box<double>) collide_box_box<double>;

}  // namespace contactscope
