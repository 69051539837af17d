#pragma once

#include "geometry/half_space.h"
#include "geometry/sphere.h"
#include "manifold/collide_convex.h"

namespace contactscope {

/// One point, below the centre, on the plane. Fills `contact` in A's frame and returns the distance
/// of the sphere's lowest point from the plane in metres, negative below it. A plane has a normal
/// wherever the centre is, so nothing is degenerate.
template <class S>
S collide_sphere_plane(const Sphere<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions<S>& options, Contact<S>& contact,
                       Recorder<S>* recorder);

}  // namespace contactscope
