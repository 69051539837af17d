#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/manifold.h"
#include "geometry/shape.h"
#include "manifold/pair_cache.h"
#include "trace/trace.h"

/// A pair is put in order once, by collide() or collide_incremental(), and what came of it is mirrored
/// once, here, where its shapes had been traded.
namespace contactscope {

/// One manifold for convex shapes, one a triangle for meshes, none when separated.
template <class S>
using Manifolds = std::vector<Manifold<S>>;

/// Two shapes placed in the world, in the order in which they are worked on.
template <class S>
struct PlacedPair {
  const Shape<S>& a;
  const Pose<S>& pose_a;
  const Shape<S>& b;
  const Pose<S>& pose_b;
  PairCache<S>* cache = nullptr;  // nullptr: nothing is kept
};

/// "sphere-hull": what traces call a pair of such shapes.
std::string pair_kind(ShapeKind a, ShapeKind b);
template <class S>
std::string pair_kind(const Shape<S>& a, const Shape<S>& b) {
  return pair_kind(kind_of(a), kind_of(b));
}

/// The stages that are recorded where nobody says which.
inline constexpr trace::Stages kUsualStages{};

/// The manifold of the same contact when the shapes trade places: normal negated, ids flipped.
template <class S>
void mirror(Manifold<S>& manifold) {
  manifold.normal = -manifold.normal;
  manifold.axis = mirrored(manifold.axis);
  for (ContactPoint<S>& point : manifold.points) point.id = point.id.flipped();
}

/// Begins an empty record, of which names and label are set: turns the names from the order of the
/// arguments to that in which the pair is worked on.
void begin_record(ShapeKind a, ShapeKind b, bool traded, trace::Pair& record);

/// What a pair came to, also of one that nobody watched: its manifolds, and with them its state and
/// the separation of its deepest point. Without manifolds the record's separation stays. `traded`:
/// they are in the order in which the pair was worked on, and the record is turned back to that of
/// the arguments.
template <class S>
void record_manifolds(std::span<const Manifold<S>> manifolds, trace::Pair& record,
                      bool traded = false);

/// Options for shapes that were traded: the ids that a reducer kept in the frame before are of the
/// other one.
template <class S>
struct FlippedOptions {
  explicit FlippedOptions(const CollideOptions<S>& given);
  FlippedOptions(const FlippedOptions&) = delete;

  std::vector<FeatureId> previous;
  CollideOptions<S> options;
};

/// Runs work(pair, options), which fills `manifolds` and, where there is one, `record` for a pair in
/// the order in which it is worked on: that of the arguments, `given`, or the other one where they
/// are `traded`. Leaves both in the order of the arguments.
template <class S, class Work>
[[gnu::always_inline]] inline void work_in_order(const PlacedPair<S>& given, bool traded,
                                                 const CollideOptions<S>& options,
                                                 Manifolds<S>& manifolds, trace::Pair* record,
                                                 const Work& work) {
  const auto& [a, pose_a, b, pose_b, cache] = given;
  const PlacedPair<S> pair = traded ? PlacedPair<S>{b, pose_b, a, pose_a, cache} : given;
  if (record != nullptr) [[unlikely]]
    begin_record(kind_of(pair.a), kind_of(pair.b), traded, *record);
  std::unique_ptr<FlippedOptions<S>> flipped;
  if (traded && !options.reduction.previous.empty()) [[unlikely]]
    flipped = std::make_unique<FlippedOptions<S>>(options);
  work(pair, flipped ? flipped->options : options);
  if (record != nullptr) [[unlikely]]
    record_manifolds<S>(manifolds, *record, traded);
  if (!traded) return;
  for (Manifold<S>& manifold : manifolds) mirror(manifold);
}

}  // namespace contactscope
