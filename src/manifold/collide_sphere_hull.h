#pragma once

#include "geometry/hull.h"
#include "geometry/sphere.h"
#include "manifold/collide_convex.h"

namespace contactscope {

/// Gregorius 2015, "Sphere vs Hull". Shallow, with the centre outside: the one point is the hull's
/// closest to the centre, and the normal joins them. Deep, with the centre inside: the centre's
/// projection onto the face of least penetration, and that face's normal. Where the centre passes
/// from one to the other through a face both give the same. Fills `contact` in A's frame and returns
/// the distance of the surfaces in metres, negative in overlap; of shapes that are farther apart than
/// the margin some distance along a face normal that is not larger.
///
/// There is no one normal where the centre lies on an edge or a vertex within rounding, and inside
/// where several faces that look elsewhere are equally near. The fallback is the normal of the
/// earliest of the nearest faces.
template <class S>
S collide_sphere_hull(const Sphere<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                      const CollideOptions<S>& options, Contact<S>& contact, Recorder<S>* recorder);

}  // namespace contactscope
