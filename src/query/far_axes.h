#pragma once

#include <limits>

#include "query/sat.h"

namespace contactscope {

/// An upper bound, metres, of the separation along every axis of the separating axis test that
/// points elsewhere than `normal` (unit, from A to B, A's frame): face normals n of either hull with
/// n . normal < `cosine`, and the parts of the arcs of A's edges on the Gauss map for which that
/// holds, whether or not an edge of B crosses them now. `cosine` is in (0, 1).
///
/// Never less than `floor` (< 0), which saves looking closer at what lies below. +infinity where an
/// arc may hold an axis that separates, and where the bound would be above `ceiling`, which ends the
/// search. `faces_a` and `faces_b` are what the face queries found.
template <class S>
S far_separation(const HullPair<S>& pair, const FaceSeparations<S>& faces_a,
                 const FaceSeparations<S>& faces_b, const Vec3<S>& normal, S cosine, S floor,
                 S ceiling = std::numeric_limits<S>::infinity());

}  // namespace contactscope
