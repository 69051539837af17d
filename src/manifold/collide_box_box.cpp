#include "manifold/collide_box_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "manifold/clip_rectangle.h"
#include "manifold/edge_contact.h"
#include "query/box_sat.h"

namespace contactscope {
namespace {

using boxes::BoxAxis;
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
  const Mat3<S>& r = pair.rotation;
  const EightSums<S> along(pair.arms.of[0][axis], pair.arms.of[1][axis], pair.arms.of[2][axis]);
  const S shift = pair.position[axis];
  const int support = earliest_least<S>(sign * (along.of[0] + shift) - half[axis],
                                        sign * (along.of[1] + shift) - half[axis]);
  const Vec3<S> cosines(sign * r(axis, 0), sign * r(axis, 1), sign * r(axis, 2));
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
  const Mat3<S>& r = pair.rotation;
  const Vec3<S> cosines(sign * r(0, axis), sign * r(1, axis), sign * r(2, axis));
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

/// The edges of both boxes in the order in which an id names them, A's before B's. A table, because a
/// reference that was written as two bytes and an int would be waited for when it is read as one.
constexpr std::array<FeatureRef, 24> kEdgeRefs = [] {
  std::array<FeatureRef, 24> refs;
  for (int i = 0; i < 24; ++i)
    refs[static_cast<std::size_t>(i)] = edge_ref(i < 12 ? Owner::A : Owner::B, i % 12);
  return refs;
}();
/// Of each face the edges of its ring, as places in that table: of A's faces, then of B's.
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
                                                S margin, Contact<S>& contact, S& deepest) {
  RectanglePair<S> rectangles;
  rectangles.thickness = clip_thickness(pair.scale);
  const bool of_a = axis.reference == Owner::A;
  const FacePair<S> faces = of_a ? face_of_a(pair, axis.face.face, rectangles)
                                 : face_of_b(pair, axis.directions, axis.face.face, rectangles);
  boxes::ClippedRectangle<S> clipped;
  if (!boxes::clip_rectangle(rectangles, clipped)) [[unlikely]]
    return false;

  std::array<std::array<std::uint8_t, 4>, 2>
      edges;  // places in kEdgeRefs, as ClippedRectangle has them
  edges[0] = kRingEdges[static_cast<std::size_t>(faces.incident + (of_a ? 6 : 0))];
  edges[1] = kRingEdges[static_cast<std::size_t>(axis.face.face + (of_a ? 0 : 6))];
  contact.axis = of_a ? AxisKind::FaceA : AxisKind::FaceB;
  contact.normal = of_a ? faces.plane.normal : Vec3<S>(-faces.plane.normal);
  contact.points.clear();
  deepest = std::numeric_limits<S>::infinity();
  for (int i = 0; i < clipped.count; ++i) {
    const int place = clipped.place(i);
    const Vec3<S> position = boxes::vector<S>(clipped.positions[place]);
    const S separation = faces.plane.distance(position);
    if (!(separation <= margin)) continue;
    const Vec3<S> moved = position - separation * faces.plane.normal;
    const unsigned crossing = clipped.crossings[place];
    const auto edge = [&](unsigned number) { return edges[number >> 2][number & 3U]; };
    const std::uint8_t one = edge(crossing & 7U), two = edge(crossing >> 4);
    contact.points.push_back({moved, separation, {}});
    // One after the other, for the same reason.
    contact.points.back().id.first = kEdgeRefs[std::min(one, two)];
    contact.points.back().id.second = kEdgeRefs[std::max(one, two)];
    deepest = separation < deepest ? separation : deepest;
  }
  contact.type = face_contact_type(contact.points.size());
  return true;
}

template <class S>
[[gnu::always_inline]] inline void edge_contact(const BoxPair<S>& pair, const BoxAxis<S>& axis,
                                                Contact<S>& contact) {
  const EdgeQuery<S>& edge = axis.edge;
  const ClosestPoints<S> closest =
      closest_points(boxes::edge_of_a(pair, edge.edge_a),
                     boxes::edge_of_b(pair, axis.directions, edge.edge_b), edge);
  create_edge_contact(closest, edge, contact);
}

}  // namespace

/// As collide_hull_hull(), in the same steps.
template <class S>
[[gnu::flatten]] bool collide_box_box(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                                      const CollideOptions& options, Contact<S>& contact) {
  // A rotation that is none, or not finite.
  if (!(std::abs(b_in_a.rotation.squaredNorm() - S(1)) <= S(8) * std::numeric_limits<S>::epsilon()))
    return false;
  const BoxPair<S> pair(a, b, b_in_a);
  const S margin = static_cast<S>(options.margin);
  const BoxAxis<S> axis = boxes::box_sat(pair, margin, options.preference);
  if (axis.verdict == Verdict::Separated) return true;
  if (axis.verdict == Verdict::Undecided) return false;
  if (axis.verdict == Verdict::Edge) {
    edge_contact(pair, axis, contact);
    return true;
  }
  S deepest;
  if (!face_contact(pair, axis, margin, contact, deepest)) return false;
  // As in create_contact(). Where the contact is not as deep as the axis, that takes another.
  if (axis.deepest > S(0)) return true;
  const S preferred = options.preference == Preference::Relative
                          ? preference_tolerance(axis.deepest, pair.min_radius)
                          : S(0);
  if (deepest <= axis.deepest + preferred + depth_rounding(pair.scale)) return true;
  contact.points.clear();
  return false;
}

template decltype(collide_box_box<float>) collide_box_box<float>;
template decltype(collide_box_box<double>) collide_box_box<double>;

}  // namespace contactscope
