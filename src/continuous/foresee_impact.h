#pragma once

#include <optional>

#include "continuous/search_impact.h"

namespace contactscope {

/// Advances `result.time`, at which the separation exceeds the target, to a later safe time: near
/// the first impact, or the end of the search if there is none. Returns the closest points there if
/// they are known without a measurement. `radii`: sum of both surfaces' radii, metres.
///
/// Polyhedra that do not turn are cast against each other (portal_cast.h). If one turns, repeated
/// casts with the velocities of the approaching points converge like Newton's method. Along the
/// axis found, balls about the pivots usually prove that there is no earlier contact; otherwise
/// safe_fraction() bounds the safe part, for two more support points. Round shapes do not advance:
/// their difference has no faces, so a portal would shrink to a point, and GJK is cheaper.
template <class S>
std::optional<Closest<S>> foresee_impact(Approach<S>& approach, S radii,
                                         const Separation<S>& separation, ImpactResult<S>& result,
                                         ImpactRun<S>* run);

}  // namespace contactscope
