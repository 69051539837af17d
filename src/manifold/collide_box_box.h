#pragma once

#include <vector>

#include "geometry/hull.h"
#include "manifold/collide_options.h"
#include "manifold/contact.h"
#include "manifold/pair_cache.h"

namespace contactscope {

/// collide() for two boxes (Hull::is_box) by the separating axis test, where nobody watches and nothing
/// is kept between calls: the same manifold, bit for bit, in a third of the time, or none where they are
/// apart. `manifolds` is empty when it is called.
///
/// False, and `manifolds` empty, where rounding would decide: two axes that are equally deep within
/// rounding, a rotation that is not unit, contacts that are to be taken from another axis than the
/// preferred one. Then collide_hull_hull() is to be asked.
template <class S>
bool collide_box_box(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                     const Pose<S>& pose_b, const CollideOptions& options,
                     std::vector<Manifold<S>>& manifolds);

/// collide_from_cache() for two boxes whose cache holds a face axis, where nobody watches: what it takes
/// for a hit is one here, with the same manifold. It does not look for the other box's support and
/// incident face where they were, as it takes no longer to find them.
///
/// False, and `manifolds` empty, where the cache does not help or rounding would decide. Then
/// collide_hull_hull() is to be asked, with the cache.
template <class S>
bool collide_boxes_from_cache(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                              const Pose<S>& pose_b, const CollideOptions& options,
                              const PairCache<S>& cache, std::vector<Manifold<S>>& manifolds);

}  // namespace contactscope
