#pragma once

#include "geometry/shape.h"
#include "manifold/pair_cache.h"
#include "trace/trace.h"

/// Gregorius 2015, "Collision Dispatching": a table of functions by the types of the two shapes. A
/// pair is ordered once, and the result mirrored if it was swapped, so half of it suffices.
namespace contactscope {

/// One manifold for convex shapes; one per direction or triangle for meshes; none when separated.
template <class S> using Manifolds = std::vector<Manifold<S>>;

/// "sphere-hull": the name of such a pair in traces.
template <class S> std::string pair_kind(const Shape<S>& a, const Shape<S>& b) {
  return std::string(to_string(kind_of(a))) + "-" + to_string(kind_of(b));
}

/// Whether shapes of these kinds make contacts, in either order. Two planes do not.
bool can_collide(ShapeKind one, ShapeKind other);

/// Whether a pair of these kinds, in either order, uses a PairCache.
bool can_cache(ShapeKind one, ShapeKind other);

/// The stages recorded by default.
inline constexpr trace::Stages kUsualStages{};

/// Contacts of two shapes placed in the world, into `manifolds` (emptied first). A pair is always
/// processed in the order of the table, two spheres or two capsules in the order of their radii
/// (larger first), other data and poses. So swapping the arguments mirrors the result bit for bit,
/// unless two round shapes are equal in all of these: then there is no normal to mirror.
///
/// Two hulls are processed in the given order, or the opposite one with options.b_first. Among
/// nearly equally deep faces the first hull's makes the contact, and an order that changed as
/// bodies move would break its coherence. Swapping the hulls selects the other hull's face in that
/// case, and otherwise mirrors the contact up to rounding.
///
/// In float, convex shapes with a size ratio of thousands are computed in double, without a cache.
/// `cache` speeds up the next call for the same pair in the same order, see pair_cache.h.
///
/// `record` is null when not recording. Otherwise each stage (optional ones if in `stages`) writes
/// its decisions there, in the order of the arguments; the result does not change. The record must
/// be empty except for its names `a` and `b` and its label, which the caller sets.
template <class S>
void collide(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b, const Pose<S>& pose_b,
             const CollideOptions& options, Manifolds<S>& manifolds,
             std::type_identity_t<PairCache<S>>* cache = nullptr, trace::Pair* record = nullptr,
             const trace::Stages& stages = kUsualStages);

/// Records the result of a pair, with or without recorded stages: its manifolds, its state and the
/// separation of its deepest point. Without manifolds the record keeps its separation.
template <class S>
void record_manifolds(std::span<const Manifold<S>> manifolds, trace::Pair& record);

/// The same contact with the shapes swapped: negates the normal, flips the ids.
template <class S> void mirror(Manifold<S>& manifold) {
  manifold.normal = -manifold.normal;
  manifold.axis = mirrored(manifold.axis);
  for (ContactPoint<S>& point : manifold.points) point.id = point.id.flipped();
}

/// Two shapes placed in the world, in processing order.
template <class S> struct PlacedPair {
  const Shape<S>& a;
  const Pose<S>& pose_a;
  const Shape<S>& b;
  const Pose<S>& pose_b;
  PairCache<S>* cache = nullptr;  // null: no cache
};

/// Runs `work` with flipped ids of the previous frame. Not inlined, to save other pairs the stack.
template <class Work>
[[gnu::noinline]] void with_flipped_ids(const CollideOptions& options, const Work& work) {
  const std::vector<FeatureId> previous = mapped(options.reduction.previous, &FeatureId::flipped);
  CollideOptions flipped = options;
  flipped.reduction.previous = previous;
  work(flipped);
}

/// Runs work(pair, options), swapped or as given; it fills `manifolds` and, if not null, `record`.
/// Afterwards both are in the order of the arguments.
template <class S, class Work>
[[gnu::always_inline]] inline void work_in_order(const PlacedPair<S>& given, bool swapped,
                                                 const CollideOptions& options,
                                                 Manifolds<S>& manifolds, trace::Pair* record,
                                                 const Work& work) {
  const auto& [a, pose_a, b, pose_b, cache] = given;
  const PlacedPair<S> pair = swapped ? PlacedPair<S>{b, pose_b, a, pose_a, cache} : given;
  if (record != nullptr) [[unlikely]] {
    if (swapped) std::swap(record->a, record->b);
    record->kind = pair_kind(pair.a, pair.b);
  }
  if (swapped && !options.reduction.previous.empty()) [[unlikely]]
    with_flipped_ids(options, [&](const CollideOptions& flipped) { work(pair, flipped); });
  else
    work(pair, options);
  if (record != nullptr) [[unlikely]] {
    record_manifolds<S>(manifolds, *record);
    if (swapped) trace::mirror(*record);
  }
  if (!swapped) return;
  for (Manifold<S>& manifold : manifolds) mirror(manifold);
}

struct FlipOptions {
  int directions = 16;     // directions and axes to try; the first six are aligned with the normal
  std::uint64_t seed = 1;  // for the other directions
};

/// Smallest change of b's pose that gives the pair other points: other ids, more or fewer of them.
/// Along each direction and about each axis through the middle of the points the change is doubled,
/// starting from a rounding, until the points differ; bisection follows. So points that come and go
/// within a factor of two may hide a smaller change. The search ends at a hundredth of the smaller
/// shape's size (metres, radians). Poses are rounded to S. Contacts use no cache or previous ids.
template <class S>
trace::Flip flip_distance(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                          const Pose<S>& pose_b, const CollideOptions& options,
                          const FlipOptions& flip = {});

}  // namespace contactscope
