#pragma once

#include "geometry/capsule.h"
#include "geometry/half_space.h"
#include "manifold/collide_convex.h"

namespace contactscope {

/// Each end of the axis carries a sphere, and each sphere below the plane (or up to the margin above
/// it) gives a point on the plane: two at most, named after the ends. A capsule whose axis is level
/// touches with an edge, any other with a point; one of length zero is a sphere and has one point.
/// Fills `contact` in A's frame and returns the distance of the lowest point from the plane in
/// metres, negative below it.
template <class S>
S collide_capsule_plane(const Capsule<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                        const CollideOptions<S>& options, Contact<S>& contact,
                        Recorder<S>* recorder);

}  // namespace contactscope
