#include "manifold/collide_sphere_mesh.h"

#include "manifold/collide_with_triangles.h"
#include "manifold/round_hull.h"
#include "query/closest_points.h"
#include "query/face_prism.h"

namespace contactscope {
namespace {

/// The triangle's closest point to the centre, and what it lies on. Triangle's frame.
template <class S>
struct Closest {
  FeatureRef feature;
  Vec3<S> outward;  // from it to the centre, metres
};

template <class S>
Closest<S> closest_on_outline(const Hull<S>& triangle, const Vec3<S>& center) {
  Closest<S> best;
  S least = std::numeric_limits<S>::infinity();
  for (int edge = 0; edge < 3; ++edge) {
    const Vec3<S>& from = triangle.origin(2 * edge);
    const Vec3<S>& to = triangle.target(2 * edge);
    const ClosestOnSegment<S> on_edge = closest_on_segment(center, from, to);
    const Vec3<S> outward = center - on_edge.point;
    const S squared = outward.squaredNorm();
    if (!(squared < least)) continue;
    least = squared;
    const bool at_end = on_edge.parameter <= S(0) || on_edge.parameter >= S(1);
    const int vertex = on_edge.parameter <= S(0) ? edge : (edge + 1) % 3;
    best = {at_end ? vertex_ref(Owner::B, vertex) : edge_ref(Owner::B, edge), outward};
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

}  // namespace

template <class S>
S collide_sphere_mesh(const Sphere<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                      const CollideOptions<S>& options, ContactSink<S>& sink,
                      Recorder<S>* recorder) {
  const Vec3<S> center = b_in_a.inverse_transform(Vec3<S>(Vec3<S>::Zero()));
  const Vec3<S> reach = Vec3<S>::Constant(a.radius);
  const SeenFromMesh<S> seen{{center - reach, center + reach}, center};

  const auto collide = [&](const PlacedTriangle<S>& triangle, Contact<S>& contact) {
    const Vec3<S> in_triangle = center - b.corner(triangle.index, 0);
    const S touching = touching_distance(length_scale(triangle.hull, triangle.in_a, S(0)));
    const S height = triangle.hull.planes[0].distance(in_triangle);
    // In the plane, within rounding, both sides are as good: the front.
    const int face = height >= -touching ? 0 : 1;
    if (projects_into(triangle.hull, face, in_triangle, S(0))) {
      const S distance = face == 0 ? height : -height;
      const S separation = distance - a.radius;
      if (separation > options.margin) return separation;
      if (distance <= touching) {
        if (recorder) [[unlikely]]
          recorder->degenerate("centre on a triangle", options.degenerate);
        if (options.degenerate == Degenerate::Skip) return separation;
      }
      const Vec3<S>& outward = triangle.hull.planes[static_cast<std::size_t>(face)].normal;
      add_point<S>(-b_in_a.rotate(outward), distance, a.radius, face_ref(Owner::B, face),
                   AxisKind::ClosestPoints, contact);
      return separation;
    }
    const Closest<S> closest = closest_on_outline(triangle.hull, in_triangle);
    const S distance = closest.outward.norm();
    const S separation = distance - a.radius;
    if (separation > options.margin) return separation;
    Vec3<S> outward = triangle.hull.planes[static_cast<std::size_t>(face)].normal;
    if (distance > touching) {
      outward = closest.outward / distance;
    } else {
      if (recorder) [[unlikely]]
        recorder->degenerate("centre on an edge or a vertex", options.degenerate);
      if (options.degenerate == Degenerate::Skip) return separation;
    }
    add_point<S>(-b_in_a.rotate(outward), distance, a.radius, closest.feature,
                 AxisKind::ClosestPoints, contact);
    return separation;
  };
  const auto on_face = [&](const PlacedTriangle<S>& triangle, int face, Contact<S>& contact) {
    const Vec3<S> in_triangle = center - b.corner(triangle.index, 0);
    const Plane<S>& plane = triangle.hull.planes[static_cast<std::size_t>(face)];
    const S distance = plane.distance(in_triangle);
    if (distance - a.radius > options.margin) return;
    if (!projects_into(triangle.hull, face, in_triangle, S(0))) return;
    add_point<S>(-b_in_a.rotate(plane.normal), distance, a.radius, face_ref(Owner::B, face),
                 AxisKind::FaceB, contact);
  };
  return collide_with_triangles(seen, b, b_in_a, options, sink, recorder, collide, on_face);
}

template CollideWithMesh<float, Sphere<float>> collide_sphere_mesh;
template CollideWithMesh<double, Sphere<double>> collide_sphere_mesh;

}  // namespace contactscope
