#pragma once

#include "geometry/capsule.h"
#include "geometry/hull.h"
#include "manifold/collide_convex.h"

namespace contactscope {

/// Gregorius 2015, "Capsule vs Hull". The deepest point lies where the segment is nearest to the
/// hull, or deepest in it: its depth is the true one, and the normal is the face's, or that of the
/// segment and an edge, or joins the closest points. It changes neither way as the segment sinks
/// through the surface.
///
/// There is a second point where the segment lies along what it touches, and its gap there is not
/// larger than the margin: at the far end of what the face's side planes leave of the segment, its
/// separation from the face; or at the far end of the stretch beside a parallel edge. It comes and
/// goes without changing the first.
///
/// Points outside are the hull's closest, points inside are projected onto the face or lie midway
/// between the two edges. Fills `contact` in A's frame and returns the separation of the deepest in
/// metres; of shapes that are farther apart than the margin some distance along an axis of the
/// separating axis test that is not larger. `options.preference` is not needed: ids stay as they are
/// when the axis changes between a face and one of its edges.
///
/// There is no one normal where the segment only touches a vertex, or one of its ends an edge,
/// within rounding; nor inside where several faces that look elsewhere are equally near. The
/// fallback is the best axis of the separating axis test, the earliest face among equals.
template <class S>
S collide_capsule_hull(const Capsule<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions<S>& options, Contact<S>& contact,
                       Recorder<S>* recorder);

}  // namespace contactscope
