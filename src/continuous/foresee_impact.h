#pragma once

#include <optional>

#include "continuous/search_impact.h"

namespace contactscope {

/// Moves `result.time`, at which the two are apart by more than the target, to where they are so for
/// certain until then: near the first impact, or to apart.until where there is none. Returns what is
/// nearest there, where that is known without a measurement. `radii`: of both surfaces, metres.
///
/// Polyhedra that do not turn are cast against each other (portal_cast.h). Where one turns, casts by
/// the speeds of the points that are to meet lead to the impact, as Newton's steps do. Along the axis
/// found there, balls about the pivots prove mostly that nothing met before; else the bound of
/// safe_fraction() says how much of the way to it is safe, for two more support points. What is round
/// stays where it is: its difference has no faces, so that a portal would shrink to a point, and it
/// costs GJK less than that.
template <class S>
std::optional<Closest<S>> foresee_impact(Approach<S>& approach, S radii, const Apart<S>& apart,
                                         ImpactResult<S>& result, ImpactRun<S>* run);

}  // namespace contactscope
