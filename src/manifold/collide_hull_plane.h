#pragma once

#include "geometry/half_space.h"
#include "geometry/hull.h"
#include "manifold/collide_convex.h"

namespace contactscope {

/// Lecture on contact generation, "Box-Plane Contact Generation": every vertex below the plane (or
/// up to the margin above it) is a point; the reducer leaves up to four. They lie on the plane (see
/// plane_contact.h) and are named after their vertices. Of a hull with more than kMaxManifoldPoints
/// vertices there, the deepest are taken.
///
/// The type tells what lies lowest: a vertex, an edge or a face, from how many vertices are as low
/// as the lowest within 0.2% of the hull's radius (with Preference::None, within rounding). It does
/// not change with the depth, also when a box that stands on a corner has sunk in so far that four
/// of its vertices are points.
///
/// Fills `contact` in A's frame and returns the distance of the lowest vertex from the plane in
/// metres, negative below it.
template <class S>
S collide_hull_plane(const Hull<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                     const CollideOptions<S>& options, Contact<S>& contact, Recorder<S>* recorder);

}  // namespace contactscope
