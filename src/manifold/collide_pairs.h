#pragma once

#include <cstring>
#include <optional>
#include <vector>

#include "geometry/shape.h"
#include "manifold/recorder.h"
#include "query/capsule_touch.h"
#include "reduce/all_finite.h"

/// The functions of the table in dispatch.h, one for each pair of shapes. They work in A's frame,
/// metres. Source of all but those with planes: Gregorius 2015, the slides of the same names.
namespace contactscope {

/// Puts a point at a place, with one store of all four numbers: who copies it next reads them as one, and
/// would wait for four stores.
template <class S>
void move(ContactPoint<S>& point, const Vec3<S>& to) {
  const typename lanes::Vector<S, 4>::Type four = {to.x(), to.y(), to.z(), point.separation};
  std::memcpy(static_cast<void*>(&point), &four, sizeof four);
}

/// The last two stages of every pair: `contact` moves from A's frame to the world, where it stays,
/// and what the reducer keeps of it becomes `manifold`. Gregorius 2015, "Contact Point Reduction".
/// Without a reducer, or one that has nothing to do, the points stay as they are.
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

/// Takes the contacts of one pair and finishes each as a manifold of its own: one for convex shapes,
/// one a triangle for meshes.
template <class S>
struct ContactSink {
  ToWorld<S> to_world;
  const CollideOptions& options;
  std::vector<Manifold<S>>& manifolds;
  Recorder<S>* recorder;  // null when nobody watches

  /// A contact without points is none. `triangle`: of a mesh.
  void add(Contact<S>& contact, int triangle = -1) {
    if (contact.points.empty()) return;
    Manifold<S>& manifold = manifolds.emplace_back();
    manifold.triangle = triangle;
    finish_contact(to_world, options, contact, manifold, recorder);
  }
};

/// What collides two convex shapes: fills `contact`, which is empty when they are apart by more than
/// the margin, and returns the distance of the surfaces, negative in overlap. `recorder` is null when
/// nobody watches.
template <class S, class A, class B>
using CollideConvex = S(const A& a, const B& b, const Pose<S>& b_in_a,
                        const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// What collides a convex shape with each triangle of a mesh that its box touches, and gives each
/// contact to the sink; see collide_with_triangles.h. Returns the least separation.
template <class S, class A>
using CollideWithMesh = S(const A& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                          const CollideOptions& options, ContactSink<S>& sink,
                          Recorder<S>* recorder);

/// The normal joins the centres, the one point lies in the middle of the two surface points.
/// Coincident centres have no normal: the fallback is the direction of B's y axis, which turns with
/// the body, so that the contact does not jump from frame to frame. Which one is B is the caller's
/// choice: see collide() in dispatch.h for one that does not depend on the order in which the shapes
/// were given.
template <class S>
S collide_sphere_sphere(const Sphere<S>& a, const Sphere<S>& b, const Pose<S>& b_in_a,
                        const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// A virtual sphere about the point of the capsule's axis that is closest to the centre, then as two
/// spheres. A centre on the axis, within rounding, has no normal: the fallback is a direction
/// perpendicular to the axis that turns with the capsule, so that the contact does not jump from
/// frame to frame.
template <class S>
S collide_sphere_capsule(const Sphere<S>& a, const Capsule<S>& b, const Pose<S>& b_in_a,
                         const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// Shallow, with the centre outside: the one point is the hull's closest to the centre, and the
/// normal joins them. Deep, with the centre inside: the centre's projection onto the face of least
/// penetration, and that face's normal. Where the centre passes from one to the other through a face
/// both give the same. Of shapes that are farther apart than the margin, returns some distance along
/// a face normal that is not larger.
///
/// There is no one normal where the centre lies on an edge or a vertex within rounding, and inside
/// where several faces that look elsewhere are equally near. The fallback is the normal of the
/// earliest of the nearest faces.
template <class S>
S collide_sphere_hull(const Sphere<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                      const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// One point, below the centre, on the plane (see collide_with_plane.cpp). A plane has a normal
/// wherever the centre is, so nothing is degenerate.
template <class S>
S collide_sphere_plane(const Sphere<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// The triangle's closest point to the centre. Triangles have two sides: a centre behind one is
/// pushed out at the back. A centre on a triangle or its outline, within rounding, has no normal: the
/// fallback, see Degenerate, is that of the front.
template <class S>
S collide_sphere_mesh(const Sphere<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                      const CollideOptions& options, ContactSink<S>& sink, Recorder<S>* recorder);

/// Virtual spheres about the closest points of the two axes. One point, or two where the axes are
/// nearly parallel and lie beside each other ("Stacking", "Clipping"); the deepest point is as deep
/// as the surfaces, whether there are one or two.
///
/// A single point is named after what it lies on, an end or the edge of each axis. Of two points,
/// each is named after the ends of A's and B's axis on its side, whichever of them reaches farther:
/// the names stay while the bodies slide along each other.
///
/// The normal is at right angles to both axes, where each reaches beyond the closest point, within
/// rounding: its part along an axis is less than 48 ulps.
///
/// Axes that meet, within rounding, have no normal. The fallback is their cross product where they
/// cross, on the side of a direction that turns with B; where they overlap in parallel it is that
/// direction itself, perpendicular to B's axis. From one to the other it turns while the angle
/// between the axes is 16 to 64 ulps of a radian, where it is rounding itself; any wider and it
/// would lean along an axis, so that contacts at its ends were deeper than the axes are. Which one
/// is B is the caller's choice, see collide() in dispatch.h.
template <class S>
S collide_capsule_capsule(const Capsule<S>& a, const Capsule<S>& b, const Pose<S>& b_in_a,
                          const CollideOptions& options, Contact<S>& contact,
                          Recorder<S>* recorder);

/// The deepest point lies where the segment is nearest to the hull, or deepest in it: its depth is
/// the true one, and the normal is the face's, or that of the segment and an edge, or joins the
/// closest points. It changes neither way as the segment sinks through the surface.
///
/// There is a second point where the segment lies along what it touches, and its gap there is not
/// larger than the margin: at the far end of what the face's side planes leave of the segment, its
/// separation from the face; or at the far end of the stretch beside a parallel edge. It comes and
/// goes without changing the first.
///
/// Points outside are the hull's closest, points inside are projected onto the face or lie midway
/// between the two edges. Returns the separation of the deepest; of shapes that are farther apart
/// than the margin some distance along an axis of the separating axis test that is not larger.
/// `options.preference` is not needed: ids stay as they are when the axis changes between a face and
/// one of its edges.
///
/// There is no one normal where the segment only touches a vertex, or one of its ends an edge,
/// within rounding; nor inside where several faces that look elsewhere are equally near. The
/// fallback is the best axis of the separating axis test, the earliest face among equals.
template <class S>
S collide_capsule_hull(const Capsule<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// The contact of a capsule where it touches a hull: `touch` in the hull's frame, in which the capsule's
/// axis is between `ends`, and which `rotation` turns to A's. A second point where the axis lies along an
/// edge or over a face, as above. `scale` is that of the pair, `reach` the largest distance of the axis
/// from the hull that makes a point, metres.
template <class S>
void add_capsule_touch(const Capsule<S>& a, const Hull<S>& b, const Mat3<S>& rotation,
                       const Vec3<S> (&ends)[2], const CapsuleTouch<S>& touch, S scale, S reach,
                       Contact<S>& contact);

/// Each end of the axis carries a sphere, and each sphere below the plane (or up to the margin above
/// it) gives a point on the plane: two at most, named after the ends. A capsule whose axis is level
/// touches with an edge, any other with a point; one of length zero is a sphere and has one point.
template <class S>
S collide_capsule_plane(const Capsule<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                        const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// The triangle as a flat hull. A segment that lies in the plane of a triangle beside it, where no
/// axis of the separating axis test looks, meets it at the closest points of segment and outline, and
/// along an edge at both ends of the stretch beside it.
template <class S>
S collide_capsule_mesh(const Capsule<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions& options, ContactSink<S>& sink, Recorder<S>* recorder);

/// Separating axis test, then a face contact by clipping or an edge contact by closest points. Returns
/// the separation along the axis that decided. Never empty when the hulls overlap. Of faces nearly as
/// deep, those of `preferred` come first. With options.penetration not Sat by
/// collide_by_penetration, which see.
///
/// With temporal coherence where `cache` is not null (see pair_cache.h): what it holds of an earlier
/// call is tried first, and a full test leaves in it what it found. A penetration method leaves
/// nothing. With a cache A's faces are those preferred.
template <class S>
S collide_hull_hull(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                    const CollideOptions& options, PairCache<S>* cache, Contact<S>& contact,
                    Recorder<S>* recorder, Owner preferred = Owner::A);

/// Two hulls by GJK and a penetration method, options.penetration, in place of the separating axis
/// test: Gregorius 2015, "Building Incremental Manifolds (1)", with the whole manifold made at once.
/// Fills `contact` in A's frame and returns the separation: metres, negative in overlap.
///
/// Steps: 1. GJK; 2. apart by more than the margin: the end; 3. apart by less: the separating axis
/// test, as a penetration method measures overlap only; 4. the method gives a normal; 5. the features
/// beside it (axes_of_normal) and the contact that they make. Empty where the separating axis
/// test is to do the pair: at step 3, and where the method gives no depth, or features that do not
/// explain it, which the record says.
///
/// The result promises what collide_hull_hull() says, but for the depth: that is as good as the
/// method's.
template <class S>
std::optional<S> collide_by_penetration(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                                        const CollideOptions& options, Contact<S>& contact,
                                        Recorder<S>* recorder);

/// collide_hull_hull for two hulls placed in the world, where the manifold is given, reduced and with
/// nothing recorded.
template <class S>
Manifold<S> collide_hull_hull(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                              const Pose<S>& pose_b, const CollideOptions& options,
                              PairCache<S>* cache = nullptr);

/// Lecture on contact generation, "Box-Plane Contact Generation": every vertex below the plane (or
/// up to the margin above it) is a point; the reducer leaves up to four. They are named after their
/// vertices. Of a hull with more than kMaxManifoldPoints vertices there, the deepest are taken.
///
/// The type tells what lies lowest: a vertex, an edge or a face, from how many vertices are as low
/// as the lowest within 0.2% of the hull's radius (with Preference::None, within rounding). It does
/// not change with the depth, also when a box that stands on a corner has sunk in so far that four
/// of its vertices are points.
template <class S>
S collide_hull_plane(const Hull<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                     const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// Two hulls, of which one, the triangle, is flat.
template <class S>
S collide_hull_mesh(const Hull<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                    const CollideOptions& options, ContactSink<S>& sink, Recorder<S>* recorder);

/// Contacts of any shape with a distance field, one manifold for each direction in which its surface
/// lies, and the least separation that was found. See collide_with_field.cpp.
template <class S>
S collide_with_field(const Shape<S>& a, const Field<S>& b, const Pose<S>& b_in_a,
                     const CollideOptions& options, ContactSink<S>& sink);

}  // namespace contactscope
