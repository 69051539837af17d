#pragma once

#include <string>
#include <vector>

#include "core/manifold.h"
#include "core/pose.h"
#include "geometry/shape.h"
#include "manifold/collide_options.h"
#include "manifold/pair_cache.h"
#include "trace/trace.h"

/// Gregorius 2015, "Collision Dispatching": a table of functions by the types of the two shapes, of
/// which the upper half is enough.
namespace contactscope {

/// One manifold for convex shapes, one a triangle for meshes, none when separated.
template <class S>
using Manifolds = std::vector<Manifold<S>>;

/// Whether shapes of these kinds make contacts, in whichever order: two planes do not.
bool can_collide(ShapeKind one, ShapeKind other);

/// Whether a pair of these kinds, in whichever order, goes by a PairCache.
bool can_cache(ShapeKind one, ShapeKind other);

/// "sphere-hull": what traces call a pair of such shapes.
template <class S>
std::string pair_kind(const Shape<S>& a, const Shape<S>& b) {
  return std::string(to_string(kind_of(a))) + "-" + to_string(kind_of(b));
}

/// The manifold of the same contact when the shapes trade places: normal negated, ids flipped.
template <class S>
void mirror(Manifold<S>& manifold);

/// Contacts of two shapes placed in the world, into `manifolds` (emptied first). A pair is always
/// worked on in the order of the table; two spheres or two capsules with the larger radius first, or
/// else by their other data and how they stand. So trading the arguments mirrors the result, bit for
/// bit, unless two round shapes are equal in all of that: no normal of theirs could be mirrored.
///
/// Two hulls are worked on in the order given: of faces that are nearly as deep the first one's
/// makes the contact, and an order that turned round as bodies move would break its coherence.
/// Trading them gives the other hull's face there, and else the same contact mirrored but for
/// rounding.
///
/// In float, convex shapes of which one is thousands of times larger than the other are worked on in
/// double (in_double.h) and have no use for a cache. `cache` keeps what helps the next call for the same pair in the same order, see
/// pair_cache.h.
template <class S>
void collide(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b, const Pose<S>& pose_b,
             const CollideOptions<S>& options, Manifolds<S>& manifolds,
             PairCache<S>* cache = nullptr);

#ifndef CONTACTSCOPE_WITHOUT_RECORDER

/// How a recorded pair is told.
struct Recording {
  const char* reducer_name = "";  // what the reduction stage is called
  trace::Stages stages;           // of the optional stages these are written
  /// The record is about `b` and `a`: everything in it mirrored, as if they had been given in that
  /// order.
  bool mirrored = false;
};

/// The same, bit for bit, and writes what each stage decided into `record`. Its names `a` and `b`
/// are set by the caller, for the order in which the record is told.
template <class S>
void collide(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b, const Pose<S>& pose_b,
             const CollideOptions<S>& options, Manifolds<S>& manifolds, const Recording& recording,
             trace::Pair& record, PairCache<S>* cache = nullptr);

#endif

}  // namespace contactscope
