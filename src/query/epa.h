#pragma once

#include "query/penetration.h"

namespace contactscope {

/// Cap on the iterations of EPA. Its polytope then has at most 4 + kMaxEpaIterations vertices and
/// never runs out of room: a closed surface of V vertices has 2V - 4 triangles.
inline constexpr int kMaxEpaIterations = 256;

/// Expanding polytope algorithm (see epa.cpp and penetration.h). `overlap` is where to start: the
/// simplex of a GJK run on the same sets, or nullptr. Of Converged, `depth` and `least_depth` are
/// the two bounds of the true depth, and no farther apart than the tolerance, up to rounding.
template <class S>
PenetrationResult<S> epa(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                         const PenetrationOptions<S>& options, const GjkSimplex<S>* overlap,
                         PenetrationSteps<S>* steps);

}  // namespace contactscope
