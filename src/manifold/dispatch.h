#pragma once

#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/at.h"
#include "core/manifold.h"
#include "core/pose.h"
#include "geometry/shape.h"
#include "manifold/collide_options.h"
#include "manifold/pair_cache.h"
#include "trace/trace.h"

/// Gregorius 2015, "Collision Dispatching": a table of functions by the types of the two shapes, of
/// which the upper half is enough. A pair is put in order once, by collide() or
/// collide_incremental(), and what came of it is mirrored once where its shapes had been traded.
namespace contactscope {

/// One manifold for convex shapes, one a triangle for meshes, none when separated.
template <class S>
using Manifolds = std::vector<Manifold<S>>;

/// "sphere-hull": what traces call a pair of such shapes.
template <class S>
std::string pair_kind(const Shape<S>& a, const Shape<S>& b) {
  return std::string(to_string(kind_of(a))) + "-" + to_string(kind_of(b));
}

/// Whether shapes of these kinds make contacts, in whichever order: two planes do not.
bool can_collide(ShapeKind one, ShapeKind other);

/// Whether a pair of these kinds, in whichever order, goes by a PairCache.
bool can_cache(ShapeKind one, ShapeKind other);

/// The stages that are recorded where nobody says which.
inline constexpr trace::Stages kUsualStages{};

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
/// double and have no use for a cache. `cache` keeps what helps the next call for the same pair in
/// the same order, see pair_cache.h.
///
/// `record` is null when nobody watches. Else what each stage decided is written there, of the
/// optional stages those in `stages`, in the order of the arguments; it is empty but for its names `a`
/// and `b` and its label, which the caller sets. That changes no bit of the result.
template <class S>
void collide(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b, const Pose<S>& pose_b,
             const CollideOptions& options, Manifolds<S>& manifolds,
             std::type_identity_t<PairCache<S>>* cache = nullptr, trace::Pair* record = nullptr,
             const trace::Stages& stages = kUsualStages);

/// What a pair came to, also of one that nobody watched: its manifolds, and with them its state and
/// the separation of its deepest point. Without manifolds the record's separation stays.
template <class S>
void record_manifolds(std::span<const Manifold<S>> manifolds, trace::Pair& record);

/// The manifold of the same contact when the shapes trade places: normal negated, ids flipped.
template <class S>
void mirror(Manifold<S>& manifold) {
  manifold.normal = -manifold.normal;
  manifold.axis = mirrored(manifold.axis);
  for (ContactPoint<S>& point : manifold.points) point.id = point.id.flipped();
}

/// Two shapes placed in the world, in the order in which they are worked on.
template <class S>
struct PlacedPair {
  const Shape<S>& a;
  const Pose<S>& pose_a;
  const Shape<S>& b;
  const Pose<S>& pose_b;
  PairCache<S>* cache = nullptr;  // nullptr: nothing is kept
};

/// The ids that a reducer kept in the frame before are of the other shape where two have traded places.
/// Not inlined: every pair would clear the room for these options.
template <class Work>
[[gnu::noinline]] void with_flipped_ids(const CollideOptions& options, const Work& work) {
  const std::vector<FeatureId> previous = mapped(options.reduction.previous, &FeatureId::flipped);
  CollideOptions flipped = options;
  flipped.reduction.previous = previous;
  work(flipped);
}

/// Runs work(pair, options), which fills `manifolds` and, where there is one, `record` for a pair in
/// the order in which it is worked on: that of the arguments, `given`, or the other one where they
/// are `traded`. Leaves both in the order of the arguments.
template <class S, class Work>
[[gnu::always_inline]] inline void work_in_order(const PlacedPair<S>& given, bool traded,
                                                 const CollideOptions& options,
                                                 Manifolds<S>& manifolds, trace::Pair* record,
                                                 const Work& work) {
  const auto& [a, pose_a, b, pose_b, cache] = given;
  const PlacedPair<S> pair = traded ? PlacedPair<S>{b, pose_b, a, pose_a, cache} : given;
  if (record != nullptr) [[unlikely]] {
    if (traded) std::swap(record->a, record->b);
    record->kind = pair_kind(pair.a, pair.b);
  }
  if (traded && !options.reduction.previous.empty()) [[unlikely]]
    with_flipped_ids(options, [&](const CollideOptions& flipped) { work(pair, flipped); });
  else
    work(pair, options);
  if (record != nullptr) [[unlikely]] {
    record_manifolds<S>(manifolds, *record);
    if (traded) trace::mirror(*record);
  }
  if (!traded) return;
  for (Manifold<S>& manifold : manifolds) mirror(manifold);
}

}  // namespace contactscope
