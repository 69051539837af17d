#include "manifold/incremental.h"

#include <algorithm>

#include "manifold/incremental_step.h"
#include "manifold/recorder.h"
#include "manifold/to_world.h"
#ifndef CONTACTSCOPE_WITHOUT_RECORDER
#include "manifold/incremental_record.h"
#include "manifold/trace_recorder.h"
#endif

namespace contactscope {
namespace {

/// Two shapes placed in the world, in the order of the table.
template <class S>
struct PersistentPair {
  const Shape<S>& a;
  const Pose<S>& pose_a;
  const Shape<S>& b;
  const Pose<S>& pose_b;
};

template <class S>
void build_cores(const PersistentPair<S>& pair, const IncrementalSettings& settings,
                 PersistentManifold<S>& persistent) {
  if (persistent.core_a != nullptr) return;
  const auto core = [&](const Shape<S>& shape) {
    return std::make_shared<const ShapeCore<S>>(core_of(shape, settings.core_margin));
  };
  persistent.core_a = core(pair.a);
  persistent.core_b = core(pair.b);
}

/// The type of a contact tells its features: of one point those that meet, of more what points
/// along a line or across a plane make of it.
template <class S>
ContactType type_of(const IncrementalStep<S>& step) {
  if (step.points.size() > 1) return face_contact_type(step.points.size());
  const PersistentContact<S>& only = step.points[0].kept;
  return contact_type(only.of_a.kind, only.of_b.kind);
}

/// Step 4, in the world. Points that stay keep their order.
template <class S, class Recorder>
void reduce_points(const CollideOptions<S>& options, const Manifold<S>& manifold,
                   IncrementalStep<S>& step, Recorder& recorder) {
  const std::span<const ContactPoint<S>> points(manifold.points.data(), manifold.points.size());
  KeptIndices kept;
  if (options.reducer != nullptr) {
    kept = reduce(options.reducer, points, manifold.normal, options.reduction).kept;
    recorder.reduction(points, manifold.normal, options.reduction.max_points, kept);
  } else {
    const std::size_t spare =
        points.size() - std::min<std::size_t>(points.size(), kMaxPersistentPoints);
    for (std::size_t i = spare; i < points.size(); ++i) kept.push_back(static_cast<int>(i));
  }
  std::size_t place = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool stays = std::find(kept.begin(), kept.end(), static_cast<int>(i)) != kept.end();
    if (stays)
      step.points[place++] = step.points[i];
    else if (step.broken.size() < step.broken.capacity())
      step.broken.push_back({step.points[i], "reduced"});
  }
  step.points.truncate(place);
}

template <class S>
void to_manifold(const ToWorld<S>& to_world, const CoreQuery<S>& query,
                 const IncrementalStep<S>& step, Manifold<S>& manifold) {
  manifold.normal = to_world.direction(query.normal);
  manifold.axis = query.axis;
  manifold.points.clear();
  for (const StandingPoint<S>& point : step.points)
    manifold.points.push_back({to_world.point(point.position()), point.separation, point.kept.id});
  if (!step.points.empty()) manifold.type = type_of(step);
}

template <class S>
void keep_points(const IncrementalStep<S>& step, PersistentManifold<S>& persistent) {
  persistent.points.clear();
  for (const StandingPoint<S>& point : step.points) persistent.points.push_back(point.kept);
}

/// One frame; what it did is left in `step` and `query`. False where nothing can be said.
template <class S, class Recorder>
bool step_in_order(const PersistentPair<S>& pair, const CollideOptions<S>& options,
                   const IncrementalOptions& incremental, PersistentManifold<S>& persistent,
                   Manifolds<S>& manifolds, CoreQuery<S>& query, IncrementalStep<S>& step,
                   Recorder& recorder) {
  manifolds.clear();
  if (!can_persist(kind_of(pair.a), kind_of(pair.b))) return false;
  build_cores(pair, incremental.settings, persistent);
  const Pose<S> b_in_a = relative_pose(pair.pose_a, pair.pose_b);
  const ShapeCore<S>& a = *persistent.core_a;
  const ShapeCore<S>& b = *persistent.core_b;
  const PenetrationMethod method = incremental.penetration;
  const auto found =
      query_cores(a, b, b_in_a, method, recorder.gjk_run(), recorder.penetration_steps());
  recorder.gjk(Pose<S>());
  if (!found) {
    persistent.points.clear();
    return false;
  }
  query = *found;
  // The separating axis test has a record of its own, of the shapes' features and not the cores'.
  if (query.overlap && method != PenetrationMethod::Sat)
    recorder.penetration(method, query.deep, nullptr);
  const S separation = query.distance - (a.margin + b.margin);
  recorder.separation(separation);
  confirm_points(persistent, b_in_a, query, incremental.settings, options.margin, step);
  if (separation <= options.margin)
    add_point(persistent, b_in_a, query, incremental.settings, step);

  const ToWorld<S> to_world(pair.pose_a);
  if (!step.points.empty()) {
    Manifold<S>& manifold = manifolds.emplace_back();
    to_manifold(to_world, query, step, manifold);
    reduce_points(options, manifold, step, recorder);
    to_manifold(to_world, query, step, manifold);
    recorder.manifold(manifold);
  }
  keep_points(step, persistent);
  return true;
}

template <class S>
bool against_the_order(const Shape<S>& a, const Shape<S>& b) {
  return kind_of(a) > kind_of(b);
}

}  // namespace

bool can_persist(ShapeKind one, ShapeKind other) {
  return one != ShapeKind::Mesh && other != ShapeKind::Mesh && can_collide(one, other);
}

template <class S>
void collide_incremental(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                         const Pose<S>& pose_b, const CollideOptions<S>& options,
                         const IncrementalOptions& incremental, PersistentManifold<S>& persistent,
                         Manifolds<S>& manifolds) {
  const bool swap = against_the_order(a, b);
  const PersistentPair<S> pair =
      swap ? PersistentPair<S>{b, pose_b, a, pose_a} : PersistentPair<S>{a, pose_a, b, pose_b};
  NoRecorder<S> recorder;
  CoreQuery<S> query;
  IncrementalStep<S> step;
  step_in_order(pair, options, incremental, persistent, manifolds, query, step, recorder);
  if (!swap) return;
  for (Manifold<S>& manifold : manifolds) mirror(manifold);
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                               \
  template void collide_incremental(                                                              \
      const Shape<S>&, const Pose<S>&, const Shape<S>&, const Pose<S>&, const CollideOptions<S>&, \
      const IncrementalOptions&, PersistentManifold<S>&, Manifolds<S>&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

#ifndef CONTACTSCOPE_WITHOUT_RECORDER

template <class S>
void collide_incremental(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                         const Pose<S>& pose_b, const CollideOptions<S>& options,
                         const IncrementalOptions& incremental, PersistentManifold<S>& persistent,
                         Manifolds<S>& manifolds, const Recording& recording, trace::Pair& record) {
  const bool swap = against_the_order(a, b);
  const PersistentPair<S> pair =
      swap ? PersistentPair<S>{b, pose_b, a, pose_a} : PersistentPair<S>{a, pose_a, b, pose_b};
  const bool told_mirrored = recording.mirrored != swap;
  record.kind = told_mirrored ? pair_kind(pair.b, pair.a) : pair_kind(pair.a, pair.b);
  record.incremental.reset();
  const ToWorld<S> to_world(pair.pose_a);
  TraceRecorder<S> recorder(to_world, recording.reducer_name, recording.stages, told_mirrored,
                            record);
  CoreQuery<S> query;
  IncrementalStep<S> step;
  if (step_in_order(pair, options, incremental, persistent, manifolds, query, step, recorder))
    record.incremental = told_step(to_world, query, step, persistent, incremental, told_mirrored);
  if (!swap) return;
  for (Manifold<S>& manifold : manifolds) mirror(manifold);
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                    \
  template void collide_incremental(const Shape<S>&, const Pose<S>&, const Shape<S>&,  \
                                    const Pose<S>&, const CollideOptions<S>&,          \
                                    const IncrementalOptions&, PersistentManifold<S>&, \
                                    Manifolds<S>&, const Recording&, trace::Pair&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

#endif

}  // namespace contactscope
