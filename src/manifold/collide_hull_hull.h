#pragma once

#include "core/pose.h"
#include "geometry/hull.h"
#include "manifold/collide_convex.h"
#include "manifold/pair_cache.h"

namespace contactscope {

/// Gregorius 2015, "Hull vs Hull": separating axis test, then a face contact by clipping or an edge
/// contact by closest points. Fills `contact` in A's frame and returns the separation along the
/// axis that decided: metres, negative in overlap. Empty when the hulls are apart by more than the
/// margin; never empty when they overlap. Of faces nearly as deep, those of `preferred` come first.
/// With options.penetration not Sat by collide_by_penetration.h, which see. `recorder` is null when
/// nobody watches.
template <class S>
S collide_hull_hull(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                    const CollideOptions<S>& options, Contact<S>& contact, Recorder<S>* recorder,
                    Owner preferred = Owner::A);

/// The same with temporal coherence (see pair_cache.h): what `cache` holds of an earlier call is
/// tried first, and a full test leaves in it what it found. A penetration method leaves nothing.
template <class S>
S collide_hull_hull(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                    const CollideOptions<S>& options, PairCache<S>& cache, Contact<S>& contact,
                    Recorder<S>* recorder);

/// The same for two hulls placed in the world, where the manifold is given, reduced and with
/// nothing recorded.
template <class S>
Manifold<S> collide_hull_hull(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                              const Pose<S>& pose_b, const CollideOptions<S>& options,
                              PairCache<S>* cache = nullptr);

}  // namespace contactscope
