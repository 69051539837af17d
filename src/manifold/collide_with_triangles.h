#pragma once

#include <algorithm>
#include <limits>

#include "geometry/triangle_hull.h"
#include "manifold/contact_sink.h"
#include "manifold/internal_edges.h"
#include "query/tolerance.h"

namespace contactscope {

/// A convex shape as a mesh sees it: mesh frame, metres.
template <class S>
struct SeenFromMesh {
  Aabb<S> box;
  Vec3<S> center;  // a point inside
};

/// How far from the origin of either frame anything of the shape gets: a bound on what rounds.
template <class S>
S reach_of(const SeenFromMesh<S>& shape, const Pose<S>& b_in_a) {
  return shape.box.lower.cwiseAbs().cwiseMax(shape.box.upper.cwiseAbs()).maxCoeff() +
         b_in_a.position.norm();
}

/// Distance of two boxes in metres; 0 when they overlap.
template <class S>
S box_distance(const Aabb<S>& a, const Aabb<S>& b) {
  const Vec3<S> gap = (a.lower - b.upper).cwiseMax(b.lower - a.upper).cwiseMax(S(0));
  return gap.norm();
}

/// What every convex shape does with a mesh. Gregorius 2015, "Mesh Contacts". Steps:
/// 1. collect the triangles whose boxes the shape's box touches, grown by the margin;
/// 2. each one is a flat hull that collides by itself (`collide`), one contact a triangle;
/// 3. a contact on an edge or corner that the surface does not have gives way to one on the face
///    (`on_face`), which has no points where the shape is not over it: see internal_edges.h.
///
/// collide(triangle, contact) returns the separation; on_face(triangle, face, contact) gets the face
/// of the triangle on the side of the shape's centre. Both work in A's frame, where the triangle
/// hull is placed by `triangle.in_a`. Returns the least separation, metres; when no triangle is
/// near, that is a lower bound, for the record, from the boxes.
template <class S>
struct PlacedTriangle {
  const Hull<S>& hull;
  Pose<S> in_a;
  int index;
};

template <class S, class Recorder, class Collide, class OnFace>
S collide_with_triangles(const SeenFromMesh<S>& shape, const Mesh<S>& b, const Pose<S>& b_in_a,
                         const CollideOptions<S>& options, ContactSink<S, Recorder>& sink,
                         Recorder& recorder, const Collide& collide, const OnFace& on_face) {
  const Vec3<S> grown = Vec3<S>::Constant(options.margin + tie_tolerance(reach_of(shape, b_in_a)));
  const Aabb<S> box{shape.box.lower - grown, shape.box.upper + grown};
  recorder.tree(b, box);

  TriangleHull<S> triangle;
  S least = std::numeric_limits<S>::infinity();
  b.tree.query(box, [&](int index) {
    triangle.set(b, index);
    const PlacedTriangle<S> placed{
        triangle.hull(), {b_in_a.rotation, b_in_a.transform(triangle.origin())}, index};
    Contact<S> contact;
    least = std::min(least, collide(placed, contact));
    if (contact.points.empty()) return;
    if (options.internal_edges &&
        !belongs_to_surface(b, index, Vec3<S>(-b_in_a.inverse_rotate(contact.normal)))) {
      const bool in_front = b.normal(index).dot(Vec3<S>(shape.center - triangle.origin())) >= S(0);
      contact.points.clear();
      on_face(placed, in_front ? 0 : 1, contact);
    }
    sink.add(contact, index);
  });
  if (Recorder::kRecords && least == std::numeric_limits<S>::infinity()) {
    for (const Aabb<S>& leaf : b.tree.boxes) least = std::min(least, box_distance(shape.box, leaf));
  }
  return least;
}

}  // namespace contactscope
