#include "manifold/collide_capsule_mesh.h"

#include "manifold/collide_capsule_hull.h"
#include "manifold/collide_with_triangles.h"
#include "manifold/round_hull.h"
#include "query/closest_points.h"
#include "query/face_prism.h"

namespace contactscope {
namespace {

FeatureRef segment_feature(Owner owner, int segment_start, int segment_end, int segment, bool start,
                           bool end) {
  if (start) return vertex_ref(owner, segment_start);
  return end ? vertex_ref(owner, segment_end) : edge_ref(owner, segment);
}

/// A segment nearer to the triangle's plane than this part of the triangle's radius lies in it: the
/// axes of the separating axis test, which all look out of the plane, say little then.
template <class S>
constexpr S kInPlane = S(1e-3);

/// A segment in the triangle's plane against the triangle's outline, in the triangle's frame. None
/// of it is over or under the triangle, so the closest points are on the outline, exactly.
template <class S>
struct InPlane {
  bool applies = false;  // the segment is in the plane and does not reach into the triangle
  ClosestOfSegments<S> closest;
  FeatureId id;
};

template <class S>
InPlane<S> beside_in_plane(const Hull<S>& triangle, const Vec3<S> (&ends)[2]) {
  InPlane<S> result;
  const Plane<S>& plane = triangle.planes[0];
  const S height = std::max(std::abs(plane.distance(ends[0])), std::abs(plane.distance(ends[1])));
  if (height > kInPlane<S> * triangle.radius) return result;
  if (!clip_to_prism(triangle, 0, ends, S(0)).empty()) return result;
  result.applies = true;
  result.closest.distance = std::numeric_limits<S>::infinity();
  for (int edge = 0; edge < 3; ++edge) {
    const ClosestOfSegments<S> found =
        closest_of_segments(ends[0], ends[1], triangle.origin(2 * edge), triangle.target(2 * edge));
    if (!(found.distance < result.closest.distance)) continue;
    result.closest = found;
    result.id = FeatureId::of(
        segment_feature(Owner::A, 0, 1, 0, found.parameter_a <= S(0), found.parameter_a >= S(1)),
        segment_feature(Owner::B, edge, (edge + 1) % 3, edge, found.parameter_b <= S(0),
                        found.parameter_b >= S(1)));
  }
  return result;
}

}  // namespace

template <class S>
S collide_capsule_mesh(const Capsule<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions<S>& options, ContactSink<S>& sink,
                       Recorder<S>* recorder) {
  const Vec3<S> ends[2] = {b_in_a.inverse_transform(a.points[0]),
                           b_in_a.inverse_transform(a.points[1])};
  const Vec3<S> reach = Vec3<S>::Constant(a.radius);
  const SeenFromMesh<S> seen{{ends[0].cwiseMin(ends[1]) - reach, ends[0].cwiseMax(ends[1]) + reach},
                             S(0.5) * (ends[0] + ends[1])};
  const S core_reach = std::max(a.points[0].norm(), a.points[1].norm());

  const auto collide = [&](const PlacedTriangle<S>& triangle, Contact<S>& contact) {
    const Vec3<S>& origin = b.corner(triangle.index, 0);
    const Vec3<S> in_triangle[2] = {ends[0] - origin, ends[1] - origin};
    const S touching = touching_distance(length_scale(triangle.hull, triangle.in_a, core_reach));
    const InPlane<S> beside = beside_in_plane(triangle.hull, in_triangle);
    if (!beside.applies || beside.closest.distance <= touching) {
      return collide_capsule_hull(a, triangle.hull, triangle.in_a, options, contact, recorder);
    }
    const S separation = beside.closest.distance - a.radius;
    if (separation > options.margin) return separation;
    contact.axis = AxisKind::ClosestPoints;
    contact.type = contact_type(beside.id.first.kind, beside.id.second.kind);
    contact.normal = b_in_a.rotate(
        Vec3<S>((beside.closest.on_b - beside.closest.on_a) / beside.closest.distance));
    contact.points.push_back({triangle.in_a.transform(beside.closest.on_b), separation, beside.id});
    return separation;
  };
  const auto on_face = [&](const PlacedTriangle<S>& triangle, int face, Contact<S>& contact) {
    const Vec3<S>& origin = b.corner(triangle.index, 0);
    const Vec3<S> in_triangle[2] = {ends[0] - origin, ends[1] - origin};
    const ClippedSegment<S> clipped = clip_to_prism(triangle.hull, face, in_triangle, S(0));
    if (clipped.empty()) return;
    const Plane<S>& plane = triangle.hull.planes[static_cast<std::size_t>(face)];
    contact.axis = AxisKind::FaceB;
    contact.normal = -b_in_a.rotate(plane.normal);
    const int count = clipped.parameters[0] < clipped.parameters[1] ? 2 : 1;
    for (int end = 0; end < count; ++end) {
      const S parameter = clipped.parameters[end];
      const Vec3<S> core = in_triangle[0] + parameter * (in_triangle[1] - in_triangle[0]);
      const S distance = plane.distance(core);
      if (distance - a.radius > options.margin) continue;
      const int cut_by = clipped.edges[end];
      const FeatureId id =
          cut_by < 0 ? FeatureId::of(vertex_ref(Owner::A, end), face_ref(Owner::B, face))
                     : FeatureId::of(edge_ref(Owner::A, 0), edge_ref(Owner::B, cut_by / 2));
      contact.points.push_back(
          {triangle.in_a.transform(plane.project(core)), distance - a.radius, id});
    }
    contact.type = face_contact_type(contact.points.size());
  };
  return collide_with_triangles(seen, b, b_in_a, options, sink, recorder, collide, on_face);
}

template CollideWithMesh<float, Capsule<float>> collide_capsule_mesh;
template CollideWithMesh<double, Capsule<double>> collide_capsule_mesh;

}  // namespace contactscope
