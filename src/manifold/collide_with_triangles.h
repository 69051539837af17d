#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "geometry/triangle_hull.h"
#include "manifold/collide_pairs.h"
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

/// One triangle, and when it is asked for, the triangle as a flat hull and where that is in A's frame.
template <class S>
class PlacedTriangle {
 public:
  /// All outlive this. `hull` is made, or set to this triangle, when it is asked for.
  PlacedTriangle(const Mesh<S>& mesh, int triangle, const Pose<S>& mesh_in_a,
                 std::optional<TriangleHull<S>>& hull)
      : index(triangle), mesh_(mesh), mesh_in_a_(mesh_in_a), hull_(hull) {}

  const Hull<S>& hull() const {
    place();
    return hull_->hull;
  }
  const Pose<S>& in_a() const {
    place();
    return in_a_;
  }

  const int index;

 private:
  void place() const {
    if (is_placed_) return;
    if (!hull_) hull_.emplace();
    hull_->set(mesh_, index);
    in_a_ = {mesh_in_a_.rotation, mesh_in_a_.transform(hull_->origin)};
    is_placed_ = true;
  }

  const Mesh<S>& mesh_;
  const Pose<S>& mesh_in_a_;
  std::optional<TriangleHull<S>>& hull_;
  mutable Pose<S> in_a_;
  mutable bool is_placed_ = false;
};

/// The corner or the edge of a triangle that is a hull, at a parameter of that edge.
template <class S>
FeatureRef outline_feature(int edge, S parameter) {
  if (parameter <= S(0)) return vertex_ref(Owner::B, edge);
  return parameter >= S(1) ? vertex_ref(Owner::B, (edge + 1) % 3) : edge_ref(Owner::B, edge);
}

/// Takes points out of a contact; what is left of the points of a face may be those of an edge.
template <class S, class Predicate>
void remove_points(Contact<S>& contact, const Predicate& predicate) {
  const auto end = std::remove_if(contact.points.begin(), contact.points.end(), predicate);
  if (end == contact.points.end()) return;
  contact.points.truncate(static_cast<std::size_t>(end - contact.points.begin()));
  contact.type = face_contact_type(contact.points.size());
}

/// Points that are nearer to another part of the surface by more than this factor leave through it.
template <class S>
constexpr S kNearerSurface = S(0.5);

/// A contact that was moved to the face of its triangle leads out through that face, however far that
/// is: a box that dips over the edge of a table reaches deep behind the table's side. Takes out the
/// points to which another part of the surface is much nearer, and those that have come through
/// another part. On a flat floor all triangles are equally far, and nothing is taken out.
template <class S>
void drop_detours(const NearTriangles<S>& near, int triangle, const Pose<S>& b_in_a,
                  Contact<S>& contact) {
  remove_points(contact, [&](const ContactPoint<S>& point) {
    if (!(point.separation < S(0))) return false;
    const Vec3<S> on_mesh = b_in_a.inverse_transform(point.position);
    const Vec3<S> deep =
        b_in_a.inverse_transform(Vec3<S>(point.position - point.separation * contact.normal));
    return surface_within(near, deep, -kNearerSurface<S> * point.separation) ||
           hidden_from(near, triangle, deep, on_mesh);
  });
}

/// The deepest contact of those that were left out.
template <class S>
struct LeftOut {
  Contact<S> contact;
  int triangle = -1;
  S depth = 0;  // negative if there is one

  void add(const Contact<S>& given, int index) {
    const S given_depth = given.deepest();
    if (!(given_depth < depth)) return;
    contact = given;
    triangle = index;
    depth = given_depth;
  }

  /// Makes the contact what comes back of it beside others that are as deep as `kept` (<= 0): all
  /// of it while they are no more than a third as deep, nothing from two thirds on, and in between
  /// moved out, three times as fast as they get deeper. So nothing jumps, and what is deepest is at
  /// least half as deep as this.
  void ease(S kept, S margin) {
    const S lifted = std::max(S(0), depth - S(3) * kept);
    const bool is_needed = lifted < -depth;
    for (ContactPoint<S>& point : contact.points) point.separation += lifted;
    remove_points(contact, [&](const ContactPoint<S>& point) {
      return !is_needed || !(point.separation <= margin);
    });
  }
};

/// Whether the surface falls off from an edge of a triangle.
template <class S>
bool at_rim(const Mesh<S>& b, int triangle) {
  for (int k = 0; k < 3; ++k)
    if (b.edge_class(triangle, k) == EdgeClass::Convex) return true;
  return false;
}

/// Steps 3 and 4 of collide_with_triangles for a contact that `triangle` gives by itself. `normal` is
/// the contact's, from the mesh to the shape, in the mesh's frame.
template <class S, class OnFace>
void mend(const SeenFromMesh<S>& shape, const NearTriangles<S>& near, const Pose<S>& b_in_a,
          const PlacedTriangle<S>& triangle, const Vec3<S>& normal, bool belongs,
          const OnFace& on_face, Contact<S>& contact) {
  const Mesh<S>& b = near.mesh();
  const Vec3<S>& front = b.normal(triangle.index);
  if (!belongs) {
    const bool in_front = front.dot(Vec3<S>(shape.center - b.corner(triangle.index, 0))) >= S(0);
    contact.points.clear();
    const bool turned_over = (normal.dot(front) >= S(0)) != in_front;
    if (turned_over && at_rim(b, triangle.index)) return;
    on_face(triangle, in_front ? 0 : 1, contact);
  }
  if (!(contact.deepest() < S(0))) return;
  // The middle of the contact's points, moved into the triangle's plane.
  Vec3<S> sum = Vec3<S>::Zero();
  for (const ContactPoint<S>& point : contact.points) sum += point.position;
  Vec3<S> middle = b_in_a.inverse_transform(Vec3<S>(sum / static_cast<S>(contact.points.size())));
  const Vec3<S> above = middle - b.corner(triangle.index, 0);
  middle -= front.dot(above) * front;
  if (hidden_from(near, triangle.index, shape.center, middle)) {
    contact.points.clear();
  } else if (!belongs) {
    drop_detours(near, triangle.index, b_in_a, contact);
  }
}

/// What every convex shape does with a mesh. Gregorius 2015, "Mesh Contacts". Steps:
/// 1. collect the triangles whose boxes the shape's box touches, grown by the margin;
/// 2. each one is a flat hull that collides by itself (`collide`), one contact a triangle;
/// 3. a contact on an edge or corner that the surface does not have gives way to one on the face
///    (`on_face`), which has no points where the shape is not over it, see internal_edges.h, nor
///    where that would be a detour, see drop_detours. At a rim, where the contact leads over the
///    edge and to behind the face, that face is not the way out: the contact is left out;
/// 4. such a contact, or one with the back of a triangle, is left out where other triangles hide it
///    from the shape's centre: a box on a table is not behind the table's side;
/// 5. what was left out comes back where it is needed: the deepest of it, as step 2 made it, when
///    nothing that was kept is about half as deep, see LeftOut::ease. To part from the whole mesh the
///    shape has to part from that triangle, so this is never deeper than the mesh.
///
/// collide(triangle, contact) returns the separation, and no points above the margin or where
/// degenerate geometry is to be skipped: then nothing comes back in its place; on_face(triangle,
/// face, contact) gets the face of the triangle on the side of the shape's centre. Both work in A's
/// frame, where the triangle hull is placed by `triangle.in_a`. Returns the least separation, metres;
/// when no triangle is near, that is a lower bound, for the record, from the boxes.
///
/// is_clear(triangle) is true of triangles that are known to be apart by more than the margin; they are
/// passed over.
template <class S, class Collide, class OnFace, class IsClear>
S collide_with_triangles(const SeenFromMesh<S>& shape, const Mesh<S>& b, const Pose<S>& b_in_a,
                         const CollideOptions& options, ContactSink<S>& sink, Recorder<S>* recorder,
                         const Collide& collide, const OnFace& on_face, const IsClear& is_clear) {
  const S margin = static_cast<S>(options.margin);
  const S reach = reach_of(shape, b_in_a);
  const Vec3<S> grown = Vec3<S>::Constant(margin + tie_tolerance(reach));
  const Aabb<S> box{shape.box.lower - grown, shape.box.upper + grown};

  const NearTriangles<S> near(b, box);
  std::optional<TriangleHull<S>> hull;
  S least = std::numeric_limits<S>::infinity();
  S kept = 0;  // depth of what was added or skipped, negative
  LeftOut<S> left_out;
  const auto collide_triangle = [&](int index) {
    if (is_clear(index)) return;
    const PlacedTriangle<S> placed(b, index, b_in_a, hull);
    Contact<S> contact;
    const S separation = collide(placed, contact);
    least = std::min(least, separation);
    if (contact.points.empty()) {
      kept = std::min(kept, separation);
      return;
    }
    if (options.internal_edges) {
      const Vec3<S> normal = -b_in_a.inverse_rotate(contact.normal);
      const bool belongs = belongs_to_surface(b, index, normal);
      const bool is_back = normal.dot(b.normal(index)) < S(-0.99);
      if (!belongs || is_back) {
        const Contact<S> given = contact;
        mend(shape, near, b_in_a, placed, normal, belongs, on_face, contact);
        if (contact.points.empty()) left_out.add(given, index);
      }
    }
    kept = std::min(kept, contact.deepest());
    sink.add(contact, index);
  };
  if (recorder) [[unlikely]] {
    for (const int index : recorder->query_tree(b, box)) collide_triangle(index);
  } else {
    near.each(collide_triangle);
  }
  left_out.ease(kept, margin);
  sink.add(left_out.contact, left_out.triangle);
  if (recorder && least == std::numeric_limits<S>::infinity()) {
    for (const Aabb<S>& leaf : b.tree.boxes) {
      const Vec3<S> gap = (shape.box.lower - leaf.upper).cwiseMax(leaf.lower - shape.box.upper);
      least = std::min(least, Vec3<S>(gap.cwiseMax(S(0))).norm());
    }
  }
  return least;
}

}  // namespace contactscope
