#pragma once

#include <type_traits>

#include "core/manifold.h"
#include "core/pose.h"
#include "geometry/shape.h"
#include "manifold/collide_options.h"
#include "manifold/pair_cache.h"
#include "manifold/pair_order.h"

/// Gregorius 2015, "Collision Dispatching": a table of functions by the types of the two shapes, of
/// which the upper half is enough.
namespace contactscope {

/// Whether shapes of these kinds make contacts, in whichever order: two planes do not.
bool can_collide(ShapeKind one, ShapeKind other);

/// Whether a pair of these kinds, in whichever order, goes by a PairCache.
bool can_cache(ShapeKind one, ShapeKind other);

/// Contacts of two shapes placed in the world, into `manifolds` (emptied first). A pair is always
/// worked on in the order of the table; two spheres or two capsules with the larger radius first, or
/// else by their other data and how they stand. So trading the arguments mirrors the result, bit for
/// bit, unless two round shapes are equal in all of that: no normal of theirs could be mirrored.
///
/// Two hulls are worked on in the order given, or the other one with options.b_first: of faces that
/// are nearly as deep the first one's makes the contact, and an order that turned round as bodies
/// move would break its coherence. Trading them gives the other hull's face there, and else the same
/// contact mirrored but for rounding.
///
/// In float, convex shapes of which one is thousands of times larger than the other are worked on in
/// double (in_double.h) and have no use for a cache. `cache` keeps what helps the next call for the
/// same pair in the same order, see pair_cache.h.
///
/// `record` is null when nobody watches. Else what each stage decided is written there, of the
/// optional stages those in `stages`, in the order of the arguments; it is empty but for its names `a`
/// and `b` and its label, which the caller sets. That changes no bit of the result.
template <class S>
void collide(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b, const Pose<S>& pose_b,
             const CollideOptions<S>& options, Manifolds<S>& manifolds,
             std::type_identity_t<PairCache<S>>* cache = nullptr, trace::Pair* record = nullptr,
             const trace::Stages& stages = kUsualStages);

}  // namespace contactscope
