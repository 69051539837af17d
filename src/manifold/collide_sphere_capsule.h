#pragma once

#include "geometry/capsule.h"
#include "geometry/sphere.h"
#include "manifold/collide_convex.h"

namespace contactscope {

/// Gregorius 2015, "Sphere vs Capsule": a virtual sphere about the point of the capsule's axis that
/// is closest to the centre, then as two spheres. Fills `contact` in A's frame and returns the
/// distance of the surfaces in metres, negative in overlap.
///
/// A centre on the axis, within rounding, has no normal: the fallback is a direction perpendicular
/// to the axis that turns with the capsule, so that the contact does not jump from frame to frame.
template <class S>
S collide_sphere_capsule(const Sphere<S>& a, const Capsule<S>& b, const Pose<S>& b_in_a,
                         const CollideOptions<S>& options, Contact<S>& contact,
                         Recorder<S>* recorder);

}  // namespace contactscope
