#include "manifold/collide_with_triangles.h"
#include "manifold/create_contact.h"
#include "manifold/fast/box_on_triangles.h"
#include "manifold/fast/clear_of_triangle.h"
#include "manifold/round_contact.h"

namespace contactscope {
namespace {

/// Tests each triangle that the tree finds.
constexpr auto kNoneIsClear = [](int) { return false; };

/// The triangle's closest point to the centre and its feature. Triangle's frame.
template <class S> struct Closest {
  FeatureRef feature;
  Vec3<S> outward = Vec3<S>::Zero();  // from the point to the centre, metres
};

template <class S> Closest<S> closest_on_outline(const Hull<S>& triangle, const Vec3<S>& center) {
  Closest<S> best;
  S least = std::numeric_limits<S>::infinity();
  for (int edge = 0; edge < 3; ++edge) {
    const ClosestOnSegment<S> on_edge =
        closest_on_segment(center, triangle.origin(2 * edge), triangle.target(2 * edge));
    const Vec3<S> outward = center - on_edge.point;
    const S squared = outward.squaredNorm();
    if (!(squared < least)) continue;
    least = squared;
    best = {outline_feature(edge, on_edge.parameter), outward};
  }
  return best;
}

template <class S>
void add_point(const Vec3<S>& normal, S distance, S radius, const FeatureRef& feature,
               AxisKind axis, Contact<S>& contact) {
  contact.axis = axis;
  contact.type = contact_type(FeatureKind::Vertex, feature.kind);
  contact.normal = normal;
  // The centre is the origin of A's frame.
  contact.points.push_back(
      {distance * normal, distance - radius, FeatureId::of(vertex_ref(Owner::A, 0), feature)});
}

/// A segment nearer to the triangle's plane than this fraction of the triangle's radius is in the
/// plane. The separating axis test's axes all lead out of the plane and are then of little use.
template <class S> constexpr S kInPlane = S(1e-3);

/// A segment in the triangle's plane against the triangle's outline, in the triangle's frame. No
/// part is above or below the triangle, so the closest points are exactly on the outline. Empty if
/// the segment is not in the plane, reaches into the triangle, or is as near as `touching`.
template <class S>
std::optional<CapsuleTouch<S>> next_to_in_plane(const Hull<S>& triangle, const Vec3<S> (&ends)[2],
                                                S touching) {
  const Plane<S>& plane = triangle.planes[0];
  const S height = std::max(std::abs(plane.distance(ends[0])), std::abs(plane.distance(ends[1])));
  if (height > kInPlane<S> * triangle.radius) return std::nullopt;
  if (!clip_to_prism(triangle, 0, ends, S(0)).empty()) return std::nullopt;
  const auto closest_on = [&](int edge) {
    return closest_of_segments(ends[0], ends[1], triangle.origin(2 * edge),
                               triangle.target(2 * edge));
  };
  ClosestOfSegments<S> closest = closest_on(0);
  int of = 0;
  for (const int edge : {1, 2}) {
    const ClosestOfSegments<S> found = closest_on(edge);
    if (!(found.distance < closest.distance)) continue;
    closest = found;
    of = edge;
  }
  if (!(closest.distance > touching)) return std::nullopt;
  const FeatureRef outline = outline_feature(of, closest.parameter_b);
  const int number = static_cast<int>(outline.index);
  CapsuleTouch<S> touch;
  touch.kind = CapsuleTouchKind::Closest;
  touch.feature = {outline.kind, outline.kind == FeatureKind::Edge ? 2 * number : number};
  touch.parameter = closest.parameter_a;
  touch.distance = closest.distance;
  touch.normal = (closest.on_a - closest.on_b) / closest.distance;
  return touch;
}

/// The hull in the mesh's frame: the box of its vertices.
template <class S> SeenFromMesh<S> seen_from_mesh(const Hull<S>& hull, const Pose<S>& b_in_a) {
  const Mat3<S> to_mesh = b_in_a.rotation.toRotationMatrix().transpose();
  SeenFromMesh<S> seen;
  const boxes::Three<S> half = boxes::three(hull.half_extents);
  for (int i = 0; i < hull.vertex_count(); ++i) {
    // Those of a box need not be fetched from memory.
    const Vec3<S> vertex =
        hull.is_box() ? boxes::vector<S>(boxes::vertex_of_box<S>(half, i)) : at(hull.vertices, i);
    seen.box.include(Vec3<S>(to_mesh * (vertex - b_in_a.position)));
  }
  seen.center = to_mesh * (hull.centroid - b_in_a.position);
  return seen;
}

}  // namespace

template <class S>
S collide_sphere_mesh(const Sphere<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                      const CollideOptions& options, ContactSink<S>& sink, Recorder<S>* recorder) {
  const Vec3<S> center = b_in_a.inverse_transform(Vec3<S>(Vec3<S>::Zero()));
  const Vec3<S> reach = Vec3<S>::Constant(a.radius);
  const SeenFromMesh<S> seen{{center - reach, center + reach}, center, a.radius};

  const auto collide = [&](const PlacedTriangle<S>& triangle, Contact<S>& contact) {
    if (!has_area(b, triangle.index)) [[unlikely]]
      return collide_flat_triangle(a, b, triangle.index, b_in_a, options, contact, recorder);
    const Vec3<S> in_triangle = center - b.corner(triangle.index, 0);
    const S touching = touching_distance(length_scale(triangle.hull(), triangle.in_a(), S(0)));
    const S height = triangle.hull().planes[0].distance(in_triangle);
    // In the plane, within rounding, both sides are equivalent: use the front.
    const int face = height >= -touching ? 0 : 1;
    Closest<S> closest;
    closest.feature = face_ref(Owner::B, face);
    S distance = face == 0 ? height : -height;
    const bool over_face = projects_into(triangle.hull(), face, in_triangle, S(0));
    if (!over_face) {
      closest = closest_on_outline(triangle.hull(), in_triangle);
      distance = closest.outward.norm();
    }
    const S separation = distance - a.radius;
    if (separation > options.margin) return separation;
    const char* geometry = over_face ? "centre on a triangle" : "centre on an edge or a vertex";
    const bool touches = !(distance > touching);
    if (touches && skips_degenerate(geometry, options, recorder)) return separation;
    Vec3<S> outward = at(triangle.hull().planes, face).normal;
    if (!over_face && !touches) outward = closest.outward / distance;
    add_point<S>(-b_in_a.rotate(outward), distance, a.radius, closest.feature,
                 AxisKind::ClosestPoints, contact);
    return separation;
  };
  const auto on_face = [&](const PlacedTriangle<S>& triangle, int face, Contact<S>& contact) {
    const Vec3<S> in_triangle = center - b.corner(triangle.index, 0);
    const Plane<S>& plane = at(triangle.hull().planes, face);
    const S distance = plane.distance(in_triangle);
    if (distance - a.radius > options.margin) return;
    if (!projects_into(triangle.hull(), face, in_triangle, S(0))) return;
    add_point<S>(-b_in_a.rotate(plane.normal), distance, a.radius, face_ref(Owner::B, face),
                 AxisKind::FaceB, contact);
  };
  return collide_with_triangles(seen, b, b_in_a, options, sink, recorder, collide, on_face,
                                kNoneIsClear);
}

template <class S>
S collide_capsule_mesh(const Capsule<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions& options, ContactSink<S>& sink, Recorder<S>* recorder) {
  const Vec3<S> ends[2] = {b_in_a.inverse_transform(a.points[0]),
                           b_in_a.inverse_transform(a.points[1])};
  const Vec3<S> reach = Vec3<S>::Constant(a.radius);
  const SeenFromMesh<S> seen{{ends[0].cwiseMin(ends[1]) - reach, ends[0].cwiseMax(ends[1]) + reach},
                             S(0.5) * (ends[0] + ends[1]),
                             a.radius};
  const S core_reach = std::max(a.points[0].norm(), a.points[1].norm());

  const auto collide = [&](const PlacedTriangle<S>& triangle, Contact<S>& contact) {
    if (!has_area(b, triangle.index)) [[unlikely]]
      return collide_flat_triangle(a, b, triangle.index, b_in_a, options, contact, recorder);
    const Vec3<S>& origin = b.corner(triangle.index, 0);
    const Vec3<S> in_triangle[2] = {ends[0] - origin, ends[1] - origin};
    const S scale = length_scale(triangle.hull(), triangle.in_a(), core_reach);
    const std::optional<CapsuleTouch<S>> touch =
        next_to_in_plane(triangle.hull(), in_triangle, touching_distance(scale));
    if (!touch)
      return collide_capsule_hull(a, triangle.hull(), triangle.in_a(), options, contact, recorder);
    const S margin = static_cast<S>(options.margin);
    if (touch->distance - a.radius <= margin)
      add_capsule_touch(a, triangle.hull(), Mat3<S>(b_in_a.rotation.toRotationMatrix()),
                        in_triangle, *touch, scale, a.radius + margin, contact);
    return touch->distance - a.radius;
  };
  const auto on_face = [&](const PlacedTriangle<S>& triangle, int face, Contact<S>& contact) {
    const Vec3<S>& origin = b.corner(triangle.index, 0);
    const Vec3<S> in_triangle[2] = {ends[0] - origin, ends[1] - origin};
    touch_along_face(triangle.hull(), triangle.in_a(), face, in_triangle, a.radius,
                     static_cast<S>(options.margin), contact);
  };
  return collide_with_triangles(seen, b, b_in_a, options, sink, recorder, collide, on_face,
                                kNoneIsClear);
}

template <class S>
S collide_hull_mesh(const Hull<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                    const CollideOptions& options, ContactSink<S>& sink, Recorder<S>* recorder) {
  if (!a.is_box()) prefetch_lanes(a), prefetch_topology(a);
  // A record needs every triangle and every axis.
  std::optional<BoxOnTriangles<S>> as_box;
  if (a.is_box() && recorder == nullptr) as_box.emplace(a, b, b_in_a, options);
  const auto collide = [&](const PlacedTriangle<S>& triangle, Contact<S>& contact) {
    if (!has_area(b, triangle.index)) [[unlikely]]
      return collide_flat_triangle(a, b, triangle.index, b_in_a, options, contact, recorder);
    // If both faces are nearly as deep, the surface's wins, because the hull's normal would turn with
    // a small tilt on a large triangle. But a sliver's normal says little about the surface.
    const Owner preferred = b.is_sliver(triangle.index) ? Owner::A : Owner::B;
    if (as_box && preferred == Owner::B && as_box->collide(triangle.index, contact))
      return S(0);  // used only for a record or a skipped contact
    PairCache<S>* const nothing_kept = nullptr;
    return collide_hull_hull(a, triangle.hull(), triangle.in_a(), options, nothing_kept, contact,
                             recorder, preferred);
  };
  const auto on_face = [&](const PlacedTriangle<S>& triangle, int face, Contact<S>& contact) {
    if (as_box && as_box->collide_face(triangle.index, face, contact)) return;
    const HullPair<S> pair(a, triangle.hull(), triangle.in_a());
    // The face query of the talk for this face alone.
    const Plane<S> plane = pair.b.plane(face);
    FaceQuery<S> query{face, 0, std::numeric_limits<S>::infinity()};
    for (int vertex = 0; vertex < pair.a.vertices.count(); ++vertex) {
      const S separation = plane.distance(pair.a.vertices[vertex]);
      if (separation < query.separation) query = {face, vertex, separation};
    }
    create_face_contact(pair, Owner::B, query, static_cast<S>(options.margin), contact, recorder);
  };
  const SeenFromMesh<S> seen = seen_from_mesh(a, b_in_a);
  if (recorder != nullptr)
    return collide_with_triangles(seen, b, b_in_a, options, sink, recorder, collide, on_face,
                                  kNoneIsClear);
  const ClearOfTriangle<S> is_clear(a, b, b_in_a, static_cast<S>(options.margin),
                                    reach_of(seen, b_in_a));
  return collide_with_triangles(seen, b, b_in_a, options, sink, recorder, collide, on_face,
                                is_clear);
}

template <class S> void Recorder<S>::triangle_begins() {
  pair_.sat.reset();
  pair_.clip.reset();
}

template <class S>
void Recorder<S>::triangle_ends(int triangle, S separation, bool touches,
                                const CollideOptions& options) {
  const auto rank = [](bool any_touches, S at) { return std::pair(!any_touches, at); };
  const bool is_next =
      options.recorded_triangle >= 0
          ? triangle == options.recorded_triangle
          : of_triangle_.triangle < 0 ||
                rank(touches, separation) < rank(of_triangle_.touches, of_triangle_.separation);
  if (is_next)
    of_triangle_ = {triangle, touches, separation, std::move(pair_.sat), std::move(pair_.clip)};
}

template <class S> void Recorder<S>::triangles_end() {
  auto& [triangle, touches, separation, sat, clip] = of_triangle_;
  pair_.sat = std::move(sat);
  pair_.clip = std::move(clip);
  if (!pair_.sat && !pair_.clip) return;
  pair_.triangle = triangle;
  if (pair_.sat) {
    if (pair_.sat->face_b) pair_.sat->face_b->face = triangle;
    if (pair_.sat->edge) pair_.sat->edge->b += 3 * triangle;
    for (trace::EdgePair& edges : pair_.sat->edge_pairs) edges.b += 3 * triangle;
  }
  if (pair_.clip)
    for (trace::ClipFace* const face : {&pair_.clip->reference, &pair_.clip->incident})
      if (face->shape == pair_.b) face->face = triangle;
}

template void Recorder<float>::triangle_begins();
template void Recorder<float>::triangle_ends(int, float, bool, const CollideOptions&);
template void Recorder<float>::triangles_end();
template void Recorder<double>::triangle_begins();
template void Recorder<double>::triangle_ends(int, double, bool, const CollideOptions&);
template void Recorder<double>::triangles_end();
CONTACTSCOPE_FLOAT_AND_DOUBLE(collide_sphere_mesh, collide_capsule_mesh, collide_hull_mesh);

}  // namespace contactscope
