#pragma once

#include "manifold/dispatch.h"

namespace contactscope {

/// Fast path of collide() for two boxes (Hull::is_box) by the separating axis test, without a
/// record or a cache: the same manifold, bit for bit, in a third of the time. `manifolds` is empty.
///
/// Returns false, with `manifolds` empty, where rounding would decide (equally deep axes, a
/// rotation that is not unit, an axis other than the preferred one): use collide_hull_hull() then.
template <class S>
bool collide_box_box(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                     const Pose<S>& pose_b, const CollideOptions& options,
                     std::vector<Manifold<S>>& manifolds);

/// Fast path of collide_from_cache() for two boxes whose cache holds a face axis, without a record:
/// it has the same hits and manifolds. It does not check the cached support and incident face of
/// the other box first, because finding them takes no longer.
///
/// Returns false, with `manifolds` empty, where the cache does not help or rounding would decide.
/// The caller then uses collide_hull_hull() with the cache.
template <class S>
bool collide_boxes_from_cache(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                              const Pose<S>& pose_b, const CollideOptions& options,
                              const PairCache<S>& cache, std::vector<Manifold<S>>& manifolds);

/// Fast path of collide() for two capsules without a record, from poses to manifold: the same bits
/// in a third of the time, for pairs whose closest points include an end of an axis.
///
/// Returns false without a manifold where the general path is needed: closest points in the middle
/// of both axes, axes that are nearly parallel, that meet or have no length; capsules of very
/// different sizes; numbers that are not finite; and wherever rounding could decide.
template <class S>
bool collide_two_capsules(const Capsule<S>& a, const Pose<S>& pose_a, const Capsule<S>& b,
                          const Pose<S>& pose_b, const CollideOptions& options,
                          Manifolds<S>& manifolds);

}  // namespace contactscope
