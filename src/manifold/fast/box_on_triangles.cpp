#include "manifold/fast/box_on_triangles.h"

#include "manifold/edge_contact.h"
#include "manifold/fast/box_face_contact.h"

namespace contactscope {
namespace {

using namespace boxes;

/// Order of the additions in heights of vertices: as in query_faces(), and as in Plane::distance().
template <class S>
inline constexpr auto kAsFaceQuery =
    [](const Three<S>& x, const Three<S>& y, const Three<S>& z) { return Three<S>((x + y) + z); };
template <class S>
inline constexpr auto kAsDistance =
    [](const Three<S>& x, const Three<S>& y, const Three<S>& z) { return dot_sum<S>(x, y, z); };

/// The lowest vertex of a box along a normal, the first of equals. `sum` adds a height's terms.
template <class S, class Sum>
[[gnu::always_inline]] inline int lowest_vertex(const Three<S>& terms, S offset, const Sum& sum) {
  const S x = terms[0], y = terms[1], z = terms[2];
  const Three<S> along_x = {-x, x, -x, x}, along_y = {-y, -y, y, y}, along_z = {z, z, z, z};
  const Three<S> low = sum(along_x, along_y, Three<S>(-along_z)) - offset;
  const Three<S> high = sum(along_x, along_y, along_z) - offset;
  const Three<S> least = lanes::smallest<S>(lanes::smaller(low, high));
  return std::countr_zero(lane_bits<S>(low == least) | lane_bits<S>(high == least) << 4 | 0x80U);
}

/// Indices into kEdgeRefs, in the order of a ring. A: the box; B: the triangle's two faces.
using EdgePlaces = std::array<std::uint8_t, 4>;
constexpr std::array<EdgePlaces, 2> kTriangleRings = {{{12, 13, 14}, {12, 14, 13}}};

/// Adds the clipped corners below the reference face, or up to `margin` above it, moved onto it.
template <class S>
[[gnu::always_inline]] inline void add_points(const ClippedRectangle<S>& clipped,
                                              const EdgePlaces& incident, const EdgePlaces& sides,
                                              const Three<S>& normal, S offset, S margin, S scale,
                                              Contact<S>& contact) {
  const S highest = highest_kept(margin, scale);
  for (int i = 0; i < clipped.count; ++i) {
    const int place = clipped.place(i);
    const Three<S>& position = clipped.positions[place];
    const S distance = sum_of<S>(position * normal) - offset;
    if (!(distance <= highest)) continue;
    const unsigned crossing = clipped.crossings[place];
    const auto edge = [&](unsigned number) {
      return number < 4 ? incident[number] : sides[number & 3U];
    };
    const std::uint8_t one = edge(crossing & 7U), two = edge(crossing >> 4);
    contact.points.push_back(
        {vector<S>(position - distance * normal), std::min(distance, margin), {}});
    contact.points.back().id.first = std::bit_cast<FeatureRef>(kEdgeRefs[std::min(one, two)]);
    contact.points.back().id.second = std::bit_cast<FeatureRef>(kEdgeRefs[std::max(one, two)]);
  }
  contact.type = face_contact_type(contact.points.size());
}

}  // namespace

template <class S>
BoxOnTriangles<S>::BoxOnTriangles(const Hull<S>& box, const Mesh<S>& mesh,
                                  const Pose<S>& mesh_in_box, const CollideOptions& options)
    : box_(box),
      mesh_(mesh),
      mesh_in_box_(mesh_in_box),
      margin_(static_cast<S>(options.margin)),
      preference_(options.preference),
      is_turn_(std::abs(mesh_in_box.rotation.squaredNorm() - S(1)) <=
               S(8) * std::numeric_limits<S>::epsilon()),
      turn_(mesh_in_box.rotation),
      half_(three(box.half_extents)) {}

/// The same steps as collide_hull_hull().
template <class S>
[[gnu::flatten]] bool BoxOnTriangles<S>::collide(int index, Contact<S>& contact) const {
  using Axis = BoxTriangleAxis<S>;
  if (!is_turn_) return false;
  const TriangleByBox<S>& triangle =
      triangle_.emplace(mesh_, index, mesh_in_box_, turn_, box_.radius);
  index_ = index;
  const Axis axis = box_triangle_sat(half_, box_.radius, triangle, margin_, preference_);
  if (axis.verdict == Axis::Separated) return true;
  if (axis.verdict == Axis::Undecided) return false;
  if (axis.verdict == Axis::Edge) {
    create_edge_contact(closest_points(axis.edge_a, axis.edge_b, axis.edge), axis.edge, contact);
    return true;
  }
  const bool done = axis.reference == Owner::B
                        ? face_of_triangle(triangle, axis.face, kAsFaceQuery<S>, contact)
                        : face_of_box(triangle, axis.face, contact);
  // As in create_contact(), which would use another axis for a contact less deep than its axis.
  if (done && is_deep_enough(contact.deepest(), axis.deepest, preference_, triangle.scale))
    return true;
  contact.points.clear();
  return false;
}

template <class S>
[[gnu::flatten]] bool BoxOnTriangles<S>::collide_face(int index, int face,
                                                      Contact<S>& contact) const {
  if (index != index_) {
    triangle_.emplace(mesh_, index, mesh_in_box_, turn_, box_.radius);
    index_ = index;
  }
  return face_of_triangle(*triangle_, face, kAsDistance<S>, contact);
}

/// create_face_contact() for the triangle's face and the box's incident face at its lowest vertex:
/// its rectangle is clipped against three sides and a fourth that excludes nothing.
template <class S>
template <class Sum>
[[gnu::always_inline]] inline bool BoxOnTriangles<S>::face_of_triangle(
    const TriangleByBox<S>& triangle, int face, const Sum& sum, Contact<S>& contact) const {
  const Three<S> normal = face == 0 ? triangle.normal : -triangle.normal;
  const S offset = face == 0 ? triangle.offset : -triangle.offset;
  const int support = lowest_vertex<S>(Three<S>(normal * half_), offset, sum);
  const int incident = incident_at<S>(support, vector<S>(normal));
  RectanglePair<S> rectangles;
  rectangles.thickness = clip_thickness(triangle.scale);
  for (std::size_t i = 0; i < 4; ++i)
    rectangles.corners[i] =
        vertex_of_box<S>(half_, kBoxFaces[static_cast<std::size_t>(incident)][i]);
  // From the back the edges come in the order 0, 2, 1, each starting at its other end.
  Three<S> sides[3], origins[3];
  for (int k = 0; k < 3; ++k) {
    sides[k] = cross<S>(triangle.directions[k], triangle.normal);
    origins[k] = triangle.corners[face == 0 ? k : (k + 1) % 3];
  }
  if (face == 1) {
    std::swap(sides[1], sides[2]);
    std::swap(origins[1], origins[2]);
  }
  const Three<S> none = {};
  const Coordinates<S> of_sides(sides[0], sides[1], sides[2], none);
  rectangles.side_x = of_sides.x;
  rectangles.side_y = of_sides.y;
  rectangles.side_z = of_sides.z;
  rectangles.side_offset = of_sides.dot(Coordinates<S>(origins[0], origins[1], origins[2], none)) +
                           Three<S>{0, 0, 0, std::numeric_limits<S>::infinity()};
  ClippedRectangle<S> clipped;
  if (!clip_rectangle(rectangles, clipped)) [[unlikely]]
    return false;
  contact.axis = AxisKind::FaceB;
  contact.normal = vector<S>(-normal);
  contact.scale = triangle.scale;
  contact.points.clear();
  add_points(clipped, kRingEdges[static_cast<std::size_t>(incident)],
             kTriangleRings[static_cast<std::size_t>(face)], normal, offset, margin_,
             triangle.scale, contact);
  return true;
}

/// create_face_contact() for the box's face and the triangle's side that faces it.
template <class S>
[[gnu::always_inline]] inline bool BoxOnTriangles<S>::face_of_box(const TriangleByBox<S>& triangle,
                                                                  int face,
                                                                  Contact<S>& contact) const {
  const int axis = face / 2;
  const S sign = face % 2 == 0 ? S(1) : S(-1);
  const int incident = sign * triangle.normal[axis] > S(0) ? 1 : 0;
  RectanglePair<S> rectangles;
  rectangles.thickness = clip_thickness(triangle.scale);
  rectangles.corners[0] = triangle.corners[incident == 0 ? 0 : 1];
  rectangles.corners[1] = triangle.corners[incident == 0 ? 1 : 0];
  rectangles.corners[2] = triangle.corners[2];
  lay_sides(half_, face, rectangles);
  ClippedRectangle<S> clipped;
  if (!clip_rectangle<3>(rectangles, clipped)) [[unlikely]]
    return false;
  contact.axis = AxisKind::FaceA;
  contact.normal = Vec3<S>::Unit(axis) * sign;
  contact.scale = triangle.scale;
  contact.points.clear();
  add_points(clipped, kTriangleRings[static_cast<std::size_t>(incident)],
             kRingEdges[static_cast<std::size_t>(face)], three(contact.normal), half_[axis],
             margin_, triangle.scale, contact);
  return true;
}

template class BoxOnTriangles<float>;
template class BoxOnTriangles<double>;

}  // namespace contactscope
