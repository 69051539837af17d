#pragma once

#include "geometry/capsule.h"
#include "manifold/collide_convex.h"

namespace contactscope {

/// Gregorius 2015, "Capsule vs Capsule": virtual spheres about the closest points of the two axes.
/// One point, or two where the axes are nearly parallel and lie beside each other ("Stacking",
/// "Clipping"). Fills `contact` in A's frame and returns the distance of the surfaces in metres,
/// negative in overlap; the deepest point is that deep, whether there are one or two.
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
                          const CollideOptions<S>& options, Contact<S>& contact,
                          Recorder<S>* recorder);

}  // namespace contactscope
