#pragma once

#include "geometry/triangle_hull.h"
#include "manifold/collide_pairs.h"
#include "manifold/internal_edges.h"
#include "query/tolerance.h"

namespace contactscope {

/// A triangle without an area: the segment between its farthest corners, a capsule of radius 0.
template <class S> struct FlatTriangle {
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

/// A convex shape and a triangle without an area, in A's frame; features are the triangle's.
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

/// A convex shape in the mesh's frame, metres.
template <class S> struct SeenFromMesh {
  Aabb<S> box;
  Vec3<S> center;  // a point inside
  S radius = 0;    // of a round shape: distance of the surface from the core
};

/// Upper bound of the shape's coordinates in either frame, for rounding.
template <class S> S reach_of(const SeenFromMesh<S>& shape, const Pose<S>& b_in_a) {
  return shape.box.lower.cwiseAbs().cwiseMax(shape.box.upper.cwiseAbs()).maxCoeff() +
         b_in_a.position.norm();
}

/// One triangle; on demand, the triangle as a flat hull and its pose in A's frame.
template <class S> class PlacedTriangle {
 public:
  /// All arguments must outlive this. `hull` is created, or set to this triangle, on demand.
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

/// The corner or the edge of a triangle hull at a parameter of that edge.
template <class S> FeatureRef outline_feature(int edge, S parameter) {
  if (parameter <= S(0)) return vertex_ref(Owner::B, edge);
  return parameter >= S(1) ? vertex_ref(Owner::B, (edge + 1) % 3) : edge_ref(Owner::B, edge);
}

/// Removes points from a contact; the rest of a face's points may be those of an edge.
template <class S, class Predicate>
void remove_points(Contact<S>& contact, const Predicate& predicate) {
  const auto end = std::remove_if(contact.points.begin(), contact.points.end(), predicate);
  if (end == contact.points.end()) return;
  contact.points.truncate(static_cast<std::size_t>(end - contact.points.begin()));
  contact.type = face_contact_type(contact.points.size());
}

/// Points that are nearer to another part of the surface by this factor leave through it.
template <class S> constexpr S kNearerSurface = S(0.5);

/// A contact moved to the face of its triangle leads out through that face, however far that is: a
/// box that dips over the edge of a table is deep behind the table's side. Removes the points to
/// which another part of the surface is much nearer, and those that have come through another part.
/// On a flat floor all triangles are equally far and nothing is removed.
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

/// Whether a contact is that of a round shape with its closest point; deeper, the core is through.
template <class S> bool is_closest_of_round(const SeenFromMesh<S>& shape, S depth) {
  return shape.radius > S(0) && depth > -shape.radius;
}

/// How far rounding may have turned the normal between the closest points, radians. Each point is
/// off by up to four roundings of coordinates around the triangle's corner, which turns the normal
/// more the closer the points are. `deepest`: the contact's.
template <class S>
S normal_tolerance(const SeenFromMesh<S>& shape, const Mesh<S>& mesh, int triangle, S deepest) {
  if (!is_closest_of_round(shape, deepest)) return kNormalTolerance<S>;
  const Vec3<S>& corner = mesh.corner(triangle, 0);
  S squared = std::max(Vec3<S>(shape.box.lower - corner).squaredNorm(),
                       Vec3<S>(shape.box.upper - corner).squaredNorm());
  for (int k = 1; k < 3; ++k)
    squared = std::max(squared, Vec3<S>(mesh.corner(triangle, k) - corner).squaredNorm());
  const S distance = deepest + shape.radius;
  return std::max(kNormalTolerance<S>, tie_tolerance(std::sqrt(squared)) / distance);
}

template <class S> void drop_deeper(S separation, Contact<S>& contact) {
  remove_points(contact,
                [&](const ContactPoint<S>& point) { return point.separation < separation; });
}

/// The deepest of the dropped contacts.
template <class S> struct LeftOut {
  Contact<S> contact;
  int triangle = -1;
  S depth = std::numeric_limits<S>::infinity();
  bool is_of_other = false;  // another shape, which continues the surface, makes it

  void add(const Contact<S>& given, int index, bool of_other) {
    const S given_depth = given.deepest();
    if (!(given_depth < depth)) return;
    contact = given;
    triangle = index;
    depth = given_depth;
    is_of_other = of_other;
  }

  /// Reduces the contact to the part that is restored next to others as deep as `kept`: all of it
  /// while they are at most a third as deep, nothing from two thirds on. In between it is moved out
  /// three times as fast as they get deeper. So the deepest contact is at least half as deep.
  ///
  /// The closest point of the whole mesh is on its surface, with nothing between it and the core.
  /// So if the closest point of a round shape is deeper than all kept contacts by more than
  /// `rounding`, it was dropped only by rounding, and is restored completely.
  void ease(S kept, S margin, bool is_closest, S rounding) {
    const S lifted = is_closest ? S(0) : std::max(S(0), depth - S(3) * std::min(kept, S(0)));
    const bool is_needed = is_closest ? depth < kept - rounding : lifted < -depth;
    for (ContactPoint<S>& point : contact.points) point.separation += lifted;
    remove_points(contact, [&](const ContactPoint<S>& point) {
      return !is_needed || is_of_other || !(point.separation <= margin);
    });
  }
};

/// The triangle's edge that made a contact with an edge of a hull; -1 for other contacts.
template <class S> int edge_of_triangle(const Contact<S>& contact) {
  const FeatureRef& of_triangle = contact.points[0].id.second;
  const bool is_edge = contact.axis == AxisKind::EdgeEdge && of_triangle.kind == FeatureKind::Edge;
  return is_edge ? static_cast<int>(of_triangle.index) : -1;
}

/// Whether the surface falls off at an edge of a triangle.
template <class S> bool at_rim(const Mesh<S>& b, int triangle) {
  for (int k = 0; k < 3; ++k)
    if (b.edge_class(triangle, k) == EdgeClass::Convex) return true;
  return false;
}

/// Steps 3 and 4 of collide_with_triangles for the contact of `triangle` alone. `normal` is the
/// contact's, from the mesh to the shape, in the mesh's frame.
template <class S, class OnFace>
void fix_near_points(const SeenFromMesh<S>& shape, const NearTriangles<S>& near,
                     const Pose<S>& b_in_a, const PlacedTriangle<S>& triangle,
                     const Vec3<S>& normal, bool belongs, const OnFace& on_face,
                     Contact<S>& contact) {
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

/// The steps for every convex shape against a mesh. Gregorius 2015, "Mesh Contacts":
/// 1. collect the triangles whose boxes touch the shape's box, grown by the margin;
/// 2. each one is a flat hull that collides by itself (`collide`), one contact per triangle;
/// 3. a contact on an edge or corner that the surface lacks is replaced by one on the face
///    (`on_face`). That has no points where the shape is not over the face, see internal_edges.h,
///    nor where the path would be a detour, see drop_detours. At a rim, where the contact leads
///    over the edge and behind the face, that face is no exit: the contact is dropped;
/// 4. such a contact, or one with the back of a triangle, is dropped if other triangles hide it
///    from the shape's centre: a box on a table is not behind the table's side;
/// 5. the deepest dropped contact, as step 2 made it, is restored if no kept contact is about half
///    as deep, see LeftOut::ease. To separate from the whole mesh the shape must separate from that
///    triangle, so this is never deeper than the mesh. But where the surface of another shape
///    continues this one, that shape makes the contact.
///
/// A triangle without an area is a segment or a point. It has no face, so step 3 drops its contact.
///
/// collide(triangle, contact) returns the separation, and no points above the margin or where
/// degenerate geometry is skipped . on_face(triangle, face, contact) gets the face of the triangle
/// on the side of the shape's centre. Both work in A's frame; `triangle.in_a` places the triangle
/// hull. Returns the least separation, metres, or of no near triangle a lower bound.
///
/// is_clear(triangle): known to be above the margin; such a triangle is skipped, unless recorded.
template <class S, class Collide, class OnFace, class IsClear>
S collide_with_triangles(const SeenFromMesh<S>& shape, const Mesh<S>& b, const Pose<S>& b_in_a,
                         const CollideOptions& options, ContactSink<S>& sink, Recorder<S>* recorder,
                         const Collide& collide, const OnFace& on_face, const IsClear& is_clear) {
  const S margin = static_cast<S>(options.margin);
  const S reach = reach_of(shape, b_in_a);
  const Vec3<S> grown = Vec3<S>::Constant(margin + tie_tolerance(reach));
  const Aabb<S> box{shape.box.lower - grown, shape.box.upper + grown};

  const NearTriangles<S> near(b, box);
  thread_local std::optional<TriangleHull<S>> hull;  // kept, because it has nine allocations
  S least = std::numeric_limits<S>::infinity();
  S kept = std::numeric_limits<S>::infinity();  // of added or skipped contacts
  LeftOut<S> left_out;
  const auto collide_triangle = [&](int index) {
    const PlacedTriangle<S> placed(b, index, b_in_a, hull);
    Contact<S> contact;
    if (recorder) [[unlikely]]
      recorder->triangle_begins();
    const S separation = collide(placed, contact);
    least = std::min(least, separation);
    if (contact.points.empty()) {
      kept = std::min(kept, separation);
      if (recorder) [[unlikely]]
        recorder->triangle_ends(index, separation, false, options);
      return;
    }
    if (options.internal_edges) {
      const S given_depth = contact.deepest();
      ContactNormal<S> normal{-b_in_a.inverse_rotate(contact.normal)};
      const bool flat = !has_area(b, index);
      const auto belongs_to_mesh = [&] {
        if (!flat && is_along_face(b, index, normal)) return true;  // most contacts, at little cost
        normal.tolerance = normal_tolerance(shape, b, index, given_depth);
        if (!flat) return belongs_to_surface(b, index, normal, edge_of_triangle(contact));
        const Vec3<S> place = b_in_a.inverse_transform(contact.points[0].position);
        return flat_belongs_to_surface(b, index, normal, place);
      };
      const bool belongs = belongs_to_mesh();
      const bool is_back = normal.direction.dot(b.normal(index)) < S(-0.99);
      if (!belongs || is_back) {
        const Contact<S> given = contact;
        if (flat)
          contact.points.clear();
        else
          fix_near_points(shape, near, b_in_a, placed, normal.direction, belongs, on_face, contact);
        const bool is_closest = is_closest_of_round(shape, given_depth);
        // Behind the face: a core that does not cross the triangle has come around its edge.
        if (is_closest) drop_deeper(given_depth - depth_rounding(reach), contact);
        const bool is_less =
            contact.points.empty() || (is_closest && contact.deepest() > given_depth);
        if (is_less) left_out.add(given, index, normal.is_of_other);
      }
    }
    kept = std::min(kept, contact.deepest());
    if (recorder) [[unlikely]]
      recorder->triangle_ends(index, contact.points.empty() ? separation : contact.deepest(),
                              !contact.points.empty(), options);
    sink.add(contact, index);
  };
  if (recorder) [[unlikely]] {
    for (const int index : recorder->query_tree(b, box)) collide_triangle(index);
    recorder->triangles_end();
  } else {
    near.each(is_clear, collide_triangle);
  }
  left_out.ease(kept, margin, is_closest_of_round(shape, left_out.depth), depth_rounding(reach));
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
