#include "manifold/collide_hull_mesh.h"

#include <algorithm>
#include <limits>

#include "manifold/collide_hull_hull.h"
#include "manifold/collide_with_triangles.h"
#include "manifold/face_contact.h"

namespace contactscope {
namespace {

/// The hull as the mesh sees it: the box of its vertices.
template <class S>
SeenFromMesh<S> seen_from_mesh(const Hull<S>& hull, const Pose<S>& b_in_a) {
  const Mat3<S> to_mesh = b_in_a.rotation.toRotationMatrix().transpose();
  SeenFromMesh<S> seen;
  for (const Vec3<S>& vertex : hull.vertices)
    seen.box.include(Vec3<S>(to_mesh * (vertex - b_in_a.position)));
  seen.center = to_mesh * (hull.centroid - b_in_a.position);
  return seen;
}

/// A triangle lower than this part of its longest edge is a sliver: what moves a corner by a little
/// turns its normal by much.
template <class S>
constexpr S kSliver = S(0.01);

/// Whose face decides where both are nearly as deep. The surface: by the hull's face a small tilt on
/// a large triangle would turn the normal. But a sliver's own normal says little of the surface.
template <class S>
Owner preferred_face(const Mesh<S>& mesh, int triangle) {
  const Vec3<S> first = mesh.corner(triangle, 1) - mesh.corner(triangle, 0);
  const Vec3<S> second = mesh.corner(triangle, 2) - mesh.corner(triangle, 1);
  const Vec3<S> third = mesh.corner(triangle, 0) - mesh.corner(triangle, 2);
  const S longest = std::max({first.squaredNorm(), second.squaredNorm(), third.squaredNorm()});
  return first.cross(second).norm() < kSliver<S> * longest ? Owner::A : Owner::B;
}

/// The face query of the talk for one face that is given.
template <class S>
FaceQuery<S> query_face(const HullPair<S>& pair, int face) {
  const Plane<S> plane = pair.b.plane(face);
  FaceQuery<S> query{face, 0, std::numeric_limits<S>::infinity()};
  for (int vertex = 0; vertex < pair.a.vertices.count(); ++vertex) {
    const S separation = plane.distance(pair.a.vertices[vertex]);
    if (separation < query.separation) query = {face, vertex, separation};
  }
  return query;
}

}  // namespace

template <class S>
S collide_hull_mesh(const Hull<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                    const CollideOptions<S>& options, ContactSink<S>& sink, Recorder<S>* recorder) {
  const auto collide = [&](const PlacedTriangle<S>& triangle, Contact<S>& contact) {
    return collide_hull_hull(a, triangle.hull, triangle.in_a, options, contact, recorder,
                             preferred_face(b, triangle.index));
  };
  const auto on_face = [&](const PlacedTriangle<S>& triangle, int face, Contact<S>& contact) {
    const HullPair<S> pair(a, triangle.hull, triangle.in_a);
    contact.axis = AxisKind::FaceB;
    contact.normal = -pair.b.normals[face];
    create_face_contact(pair, Owner::B, query_face(pair, face), options.margin, contact.points,
                        recorder);
    contact.type = face_contact_type(contact.points.size());
  };
  return collide_with_triangles(seen_from_mesh(a, b_in_a), b, b_in_a, options, sink, recorder,
                                collide, on_face);
}

template CollideWithMesh<float, Hull<float>> collide_hull_mesh;
template CollideWithMesh<double, Hull<double>> collide_hull_mesh;

}  // namespace contactscope
