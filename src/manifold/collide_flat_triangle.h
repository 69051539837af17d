#pragma once

#include "geometry/flat_triangle.h"
#include "manifold/collide_pairs.h"

namespace contactscope {

/// A triangle without an area: the segment between its two farthest corners, as a capsule of radius
/// 0. A point is a segment of length zero.
template <class S>
struct FlatTriangle {
  FlatTriangle(const Mesh<S>& mesh, int triangle, const Pose<S>& mesh_in_a)
      : edge(longest_edge(mesh, triangle)) {
    const Vec3<S>& from = mesh.corner(triangle, edge);
    const Vec3<S>& to = mesh.corner(triangle, (edge + 1) % 3);
    axis = {{Vec3<S>::Zero(), to - from}, S(0)};
    in_a = {mesh_in_a.rotation, mesh_in_a.transform(from)};
  }

  /// The triangle's feature for a feature of the capsule. Features of A are returned as they are.
  FeatureRef named(const FeatureRef& ref) const {
    if (ref.owner == Owner::A) return ref;
    if (ref.kind == FeatureKind::Edge) return edge_ref(Owner::B, edge);
    return vertex_ref(Owner::B, (edge + static_cast<int>(ref.index)) % 3);
  }

  int edge;         // of the triangle
  Capsule<S> axis;  // own frame: the mesh's axes, origin at the edge's first corner
  Pose<S> in_a;
};

/// A convex shape and a triangle without an area, in A's frame. Feature indices are within the
/// triangle. Returns the separation, metres.
template <class S, class A>
S collide_flat_triangle(const A& a, const Mesh<S>& mesh, int triangle, const Pose<S>& mesh_in_a,
                        const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder) {
  const FlatTriangle<S> flat(mesh, triangle, mesh_in_a);
  S separation;
  if constexpr (std::is_same_v<A, Sphere<S>>) {
    separation = collide_sphere_capsule(a, flat.axis, flat.in_a, options, contact, recorder);
  } else if constexpr (std::is_same_v<A, Capsule<S>>) {
    separation = collide_capsule_capsule(a, flat.axis, flat.in_a, options, contact, recorder);
  } else {
    const Pose<S> a_in_flat = relative_pose(flat.in_a, Pose<S>());
    separation = collide_capsule_hull(flat.axis, a, a_in_flat, options, contact, recorder);
    contact.axis = mirrored(contact.axis);
    contact.normal = -flat.in_a.rotate(contact.normal);
    for (ContactPoint<S>& point : contact.points) {
      point.position = flat.in_a.transform(point.position);
      point.id = point.id.flipped();
    }
  }
  for (ContactPoint<S>& point : contact.points)
    point.id = FeatureId::of(flat.named(point.id.first), flat.named(point.id.second));
  return separation;
}

}  // namespace contactscope
