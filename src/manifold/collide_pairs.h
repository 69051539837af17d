#pragma once

#include "geometry/shape.h"
#include "manifold/recorder.h"
#include "query/capsule_sat.h"

/// The functions of the table in dispatch.h, one for each pair of shapes. They work in A's frame,
/// metres. Source, except for planes: Gregorius 2015, the slides of the same names.
namespace contactscope {

/// Moves a point with one store of all four numbers. A copy reads them as one and would wait for
/// four separate stores.
template <class S> void move(ContactPoint<S>& point, const Vec3<S>& to) {
  const typename lanes::Vector<S, 4>::Type four = {to.x(), to.y(), to.z(), point.separation};
  std::memcpy(static_cast<void*>(&point), &four, sizeof four);
}

/// The last two stages of every pair: transforms `contact` in place from A's frame to the world and
/// reduces it to `manifold` (Gregorius 2015, "Contact Point Reduction"), if there is a reducer.
template <class S>
void finish_contact(const ToWorld<S>& to_world, const CollideOptions& options, Contact<S>& contact,
                    Manifold<S>& manifold, Recorder<S>* recorder) {
  if (contact.points.empty()) return;
  manifold.axis = contact.axis;
  manifold.type = contact.type;
  manifold.normal = to_world.direction(contact.normal);
  for (ContactPoint<S>& point : contact.points) move(point, to_world.point(point.position));
  const ContactPoints<S> points(contact.points.data(), contact.points.size());
  const bool few = recorder == nullptr && count_of(points) <= options.reduction.max_points &&
                   all_finite(points, manifold.normal);
  if (options.reducer == nullptr || few) {
    manifold.points = contact.points;
    return;
  }
  const ReduceOptions reduction = options.reduction_at(contact.scale);
  const KeptIndices kept =
      recorder ? recorder->reduce(options.reducer, points, manifold.normal, reduction)
               : reduce(options.reducer, points, manifold.normal, reduction);
  for (const int index : kept) manifold.points.push_back(at(points, index));
}

template <class S> class TriangleContacts;
/// TriangleContacts::add().
template <class S>
void add_to_merge(TriangleContacts<S>& contacts, const Contact<S>& contact, int triangle);

/// Collects the contacts of one pair and finishes each as its own manifold: one for convex shapes,
/// one per triangle for meshes, unless these are to be merged.
template <class S> struct ContactSink {
  ToWorld<S> to_world;
  const CollideOptions& options;
  std::vector<Manifold<S>>& manifolds;
  Recorder<S>* recorder;                  // null when not recording
  TriangleContacts<S>* merged = nullptr;  // gets the contacts instead of `manifolds`; null: none

  /// Ignores a contact without points. `triangle`: index in a mesh.
  void add(Contact<S>& contact, int triangle = -1) {
    if (contact.points.empty()) return;
    if (merged != nullptr) return add_to_merge(*merged, contact, triangle);
    Manifold<S>& manifold = manifolds.emplace_back();
    manifold.triangle = triangle;
    finish_contact(to_world, options, contact, manifold, recorder);
  }
};

/// Collides two convex shapes: fills `contact`, empty above the margin, and returns the distance of
/// the surfaces, negative in overlap. `recorder` is null when not recording.
template <class S, class A, class B>
using CollideConvex = S(const A& a, const B& b, const Pose<S>& b_in_a,
                        const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// Collides a convex shape with each triangle of a mesh that its box touches and passes each
/// contact to the sink; see collide_with_triangles.h. Returns the least separation.
template <class S, class A>
using CollideWithMesh = S(const A& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                          const CollideOptions& options, ContactSink<S>& sink,
                          Recorder<S>* recorder);

/// The normal joins the centres; the one point is midway between the two surface points. Coincident
/// centres have no normal. The fallback is the direction of B's y axis: it turns with the body, so
/// the contact does not jump between frames. The caller chooses which sphere is B; collide() in
/// dispatch.h does so independently of the order of its arguments.
template <class S>
S collide_sphere_sphere(const Sphere<S>& a, const Sphere<S>& b, const Pose<S>& b_in_a,
                        const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// A virtual sphere about the point of the capsule's axis closest to the centre, then as two
/// spheres. A centre on the axis, within rounding, has no normal. The fallback is perpendicular to
/// the axis and turns with the capsule, so the contact does not jump.
template <class S>
S collide_sphere_capsule(const Sphere<S>& a, const Capsule<S>& b, const Pose<S>& b_in_a,
                         const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// Shallow, with the centre outside: the one point is the hull's closest to the centre, and the
/// normal joins them. Deep, with the centre inside: the centre's projection onto the face of least
/// penetration, and that face's normal. The two agree where the centre passes through a face. For a
/// separation above the margin, returns a lower bound: a distance along a face normal.
///
/// The normal is not unique for a centre on an edge or a vertex within rounding, or inside and
/// equally near to several faces. The fallback is the normal of the earliest of the nearest faces.
template <class S>
S collide_sphere_hull(const Sphere<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                      const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// One point, on the plane below the centre (see collide_with_plane.cpp). Never degenerate.
template <class S>
S collide_sphere_plane(const Sphere<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// The triangle's closest point to the centre. Triangles are two-sided: a centre behind one is
/// pushed out at the back. A centre on a triangle or its outline, within rounding, has no normal.
/// The fallback (see Degenerate) is the normal of the front.
template <class S>
S collide_sphere_mesh(const Sphere<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                      const CollideOptions& options, ContactSink<S>& sink, Recorder<S>* recorder);

/// Virtual spheres about the closest points of the two axes. One point, or two if the axes are
/// nearly parallel and overlap lengthwise ("Stacking", "Clipping"). The deepest point is as deep as
/// the surfaces overlap, with one point or two.
///
/// The id of a single point is its feature, an end or the edge, of each axis. Of two points, each
/// has the ids of the ends of A's and B's axis on its side, whichever reaches farther, so the ids
/// stay while the bodies slide along each other.
///
/// The normal is perpendicular to both axes if each extends beyond the closest point, within
/// rounding: its part along an axis is less than 48 ulps.
///
/// Axes that meet, within rounding, have no normal. The fallback is their cross product where they
/// cross, on the side of a direction that turns with B. Where they overlap in parallel it is that
/// direction itself, perpendicular to B's axis. Between the two it turns while the angle of the
/// axes is 16 to 64 ulps of a radian: in a wider range it would lean along an axis, whose ends
/// would be too deep. The caller chooses which capsule is B, see collide() in dispatch.h.
template <class S>
S collide_capsule_capsule(const Capsule<S>& a, const Capsule<S>& b, const Pose<S>& b_in_a,
                          const CollideOptions& options, Contact<S>& contact,
                          Recorder<S>* recorder);

/// The deepest point is where the segment is nearest to the hull, or deepest in it. Its depth is
/// the true one. The normal is a face's, or that of the segment and an edge, or joins the closest
/// points. Neither the point nor the normal jumps as the segment sinks through the surface.
///
/// A second point exists if the segment lies along the touched feature and is not above the margin:
/// at the far end of the segment clipped to the face's side planes, or of the stretch along a
/// parallel edge. It comes and goes without changing the first point.
///
/// Points outside are the hull's closest; points inside are projected onto the face or lie midway
/// between the two edges. Returns the separation of the deepest point. For a separation above the
/// margin, returns a lower bound: a distance along an axis of the separating axis test. Does not
/// use `options.preference`, since ids are the same for a face and its edges.
///
/// The normal is not unique if the segment only touches a vertex, or one of its ends an edge,
/// within rounding; nor inside at equal distance from several faces of different directions. The
/// fallback is the best axis of the separating axis test, the earliest face among equals.
template <class S>
S collide_capsule_hull(const Capsule<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// Adds the contact of a capsule touching a hull. `touch` and `ends`, the ends of the capsule's
/// axis, are in the hull's frame, which `rotation` turns to A's. Adds a second point if the axis
/// lies along an edge or over a face, as above. `scale` is that of the pair; `reach` is the largest
/// distance of the axis from the hull that makes a point, metres.
template <class S>
void add_capsule_touch(const Capsule<S>& a, const Hull<S>& b, const Mat3<S>& rotation,
                       const Vec3<S> (&ends)[2], const CapsuleTouch<S>& touch, S scale, S reach,
                       Contact<S>& contact);

/// Each end of the axis carries a sphere, and each sphere below the plane (or up to the margin
/// above it) gives a point on the plane, with the end as id. A capsule with a level axis makes an
/// edge contact, others a point contact; one of length zero is a sphere.
template <class S>
S collide_capsule_plane(const Capsule<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                        const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// The triangle as a flat hull. No axis of the separating axis test is in the triangle's plane. So
/// a segment in that plane, outside the triangle, meets it at the closest points of segment and
/// outline, and along an edge at both ends of the common stretch.
template <class S>
S collide_capsule_mesh(const Capsule<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions& options, ContactSink<S>& sink, Recorder<S>* recorder);

/// Separating axis test, then a face contact by clipping or an edge contact by closest points.
/// Returns the separation along the deciding axis. Never empty when the hulls overlap. Among nearly
/// equally deep faces, those of `preferred` win. See also collide_by_penetration().
///
/// With a `cache` (see pair_cache.h), tries the result of an earlier call first, and prefers A's
/// faces. A full test stores its result there, a penetration method nothing.
template <class S>
S collide_hull_hull(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                    const CollideOptions& options, PairCache<S>* cache, Contact<S>& contact,
                    Recorder<S>* recorder, Owner preferred = Owner::A);

/// Two hulls by GJK and a penetration method, options.penetration, instead of the separating axis
/// test: Gregorius 2015, "Building Incremental Manifolds (1)", with the whole manifold built at
/// once. Fills `contact` in A's frame and returns the separation: metres, negative in overlap.
///
/// Steps: 1. GJK; 2. separation above the margin: done; 3. separation up to the margin: the
/// separating axis test, because penetration methods measure only overlap; 4. the method gives a
/// normal; 5. the features near it (axes_of_normal) make the contact. Returns nullopt at step 3, or
/// if the method gives no depth, or features that do not explain it.
///
/// Gives the guarantees of collide_hull_hull(), with a depth as accurate as the method's.
template <class S>
std::optional<S> collide_by_penetration(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                                        const CollideOptions& options, Contact<S>& contact,
                                        Recorder<S>* recorder);

/// collide_hull_hull for hulls placed in the world: returns the reduced manifold, without a record.
template <class S>
Manifold<S> collide_hull_hull(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                              const Pose<S>& pose_b, const CollideOptions& options,
                              PairCache<S>* cache = nullptr);

/// Lecture on contact generation, "Box-Plane Contact Generation": every vertex below the plane (or
/// up to the margin above it) is a point; the reducer keeps up to four. Their ids are the vertices.
/// If more than kMaxManifoldPoints vertices qualify, the deepest are taken.
///
/// The type is that of the lowest feature: a vertex, an edge or a face, by the number of vertices
/// within 0.2% of the hull's radius above the lowest (with Preference::None, within rounding). So
/// it does not depend on the depth, as the number of points does.
template <class S>
S collide_hull_plane(const Hull<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                     const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// A hull against each triangle as a flat hull.
template <class S>
S collide_hull_mesh(const Hull<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                    const CollideOptions& options, ContactSink<S>& sink, Recorder<S>* recorder);

/// Contacts of any shape with a distance field, one manifold per direction of the field's surface.
/// Returns the least separation found. See collide_with_field.cpp.
template <class S>
S collide_with_field(const Shape<S>& a, const Field<S>& b, const Pose<S>& b_in_a,
                     const CollideOptions& options, ContactSink<S>& sink);

/// Replaces a contact with an edge or a face that the surface of `hull` lacks, because a shape next
/// to it covers the face or continues the surface beyond the edge (Hull::seams), by one with the
/// face that the other shape is in front of. That contact has no points where the other shape is
/// not over the face: it then touches the neighbour. As belongs_to_surface() for meshes.
///
/// In A's frame. `owner` has the hull with seams. The record gets the contact that was replaced.
template <class S, class A>
void respect_seams(const A& a, const Hull<S>& b, const Pose<S>& b_in_a, Owner owner,
                   const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

}  // namespace contactscope
