#pragma once

#include <optional>

#include "geometry/hull.h"
#include "manifold/collide_convex.h"

namespace contactscope {

/// Two hulls by GJK and a penetration method, options.penetration, in place of the separating axis
/// test: Gregorius 2015, "Building Incremental Manifolds (1)", with the whole manifold made at once.
/// Fills `contact` in A's frame and returns the separation: metres, negative in overlap.
///
/// Steps: 1. GJK; 2. apart by more than the margin: the end; 3. apart by less: the separating axis
/// test, as a penetration method measures overlap only; 4. the method gives a normal; 5. the features
/// beside it (contact_from_normal.h) and the contact that they make. Empty where the separating axis
/// test is to do the pair: at step 3, and where the method gives no depth, or features that do not
/// explain it, which the record says.
///
/// The result promises what collide_hull_hull.h says, but for the depth: that is as good as the
/// method's.
template <class S>
std::optional<S> collide_by_penetration(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                                        const CollideOptions<S>& options, Contact<S>& contact,
                                        Recorder<S>* recorder);

}  // namespace contactscope
