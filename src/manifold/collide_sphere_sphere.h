#pragma once

#include "geometry/sphere.h"
#include "manifold/collide_convex.h"

namespace contactscope {

/// Gregorius 2015, "Sphere vs Sphere": the normal joins the centres, the one point lies in the
/// middle of the two surface points. Fills `contact` in A's frame and returns the distance of the
/// surfaces in metres, negative in overlap. Coincident centres have no normal: the fallback is the
/// direction of B's y axis, which turns with the body, so that the contact does not jump from frame
/// to frame. Which one is B is the caller's choice: see collide() in dispatch.h for one that does
/// not depend on the order in which the shapes were given.
template <class S>
S collide_sphere_sphere(const Sphere<S>& a, const Sphere<S>& b, const Pose<S>& b_in_a,
                        const CollideOptions<S>& options, Contact<S>& contact,
                        Recorder<S>* recorder);

}  // namespace contactscope
