#include "manifold/incremental.h"

#include <algorithm>
#include <optional>

#include "manifold/incremental_step.h"
#include "manifold/recorder.h"
#include "manifold/to_world.h"

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
template <class S>
void reduce_points(const CollideOptions<S>& options, const Manifold<S>& manifold,
                   IncrementalStep<S>& step, Recorder<S>* recorder) {
  const std::span<const ContactPoint<S>> points(manifold.points.data(), manifold.points.size());
  KeptIndices kept;
  if (options.reducer != nullptr) {
    kept = recorder ? recorder->reduce(options, points, manifold.normal).kept
                    : reduce(options.reducer, points, manifold.normal, options.reduction).kept;
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

/// One frame. Nothing where nothing can be said.
template <class S>
void step_in_order(const PersistentPair<S>& pair, const CollideOptions<S>& options,
                   const IncrementalOptions& incremental, PersistentManifold<S>& persistent,
                   Manifolds<S>& manifolds, Recorder<S>* recorder) {
  manifolds.clear();
  if (!can_persist(kind_of(pair.a), kind_of(pair.b))) return;
  build_cores(pair, incremental.settings, persistent);
  const Pose<S> b_in_a = relative_pose(pair.pose_a, pair.pose_b);
  const ShapeCore<S>& a = *persistent.core_a;
  const ShapeCore<S>& b = *persistent.core_b;
  const PenetrationMethod method = incremental.penetration;
  const auto query =
      query_cores(a, b, b_in_a, method, gjk_run(recorder), penetration_steps(recorder));
  if (recorder) [[unlikely]]
    recorder->gjk(Pose<S>());
  if (!query) {
    persistent.points.clear();
    return;
  }
  // The separating axis test has a record of its own, of the shapes' features and not the cores'.
  if (recorder && query->overlap && method != PenetrationMethod::Sat) [[unlikely]]
    recorder->penetration(method, query->deep, nullptr);
  const S separation = query->distance - (a.margin + b.margin);
  if (recorder) [[unlikely]]
    recorder->separation(separation);
  IncrementalStep<S> step;
  confirm_points(persistent, b_in_a, *query, incremental.settings, options.margin, step);
  if (separation <= options.margin)
    add_point(persistent, b_in_a, *query, incremental.settings, step);

  const ToWorld<S> to_world(pair.pose_a);
  if (!step.points.empty()) {
    Manifold<S>& manifold = manifolds.emplace_back();
    to_manifold(to_world, *query, step, manifold);
    reduce_points(options, manifold, step, recorder);
    to_manifold(to_world, *query, step, manifold);
  }
  keep_points(step, persistent);
  if (recorder) [[unlikely]]
    recorder->incremental(*query, step, persistent, incremental);
}

}  // namespace

bool can_persist(ShapeKind one, ShapeKind other) {
  return one != ShapeKind::Mesh && other != ShapeKind::Mesh && can_collide(one, other);
}

template <class S>
void collide_incremental(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                         const Pose<S>& pose_b, const CollideOptions<S>& options,
                         const IncrementalOptions& incremental, PersistentManifold<S>& persistent,
                         Manifolds<S>& manifolds, trace::Pair* record,
                         const trace::Stages& stages) {
  // Sizes and places say nothing here: points persist in one order for as long as the pair does.
  const bool traded = kind_of(a) == kind_of(b) ? options.b_first : kind_of(a) > kind_of(b);
  const PersistentPair<S> pair =
      traded ? PersistentPair<S>{b, pose_b, a, pose_a} : PersistentPair<S>{a, pose_a, b, pose_b};
  const auto work = [&](const CollideOptions<S>& in_order) {
    std::optional<Recorder<S>> recorder;
    if (record != nullptr) [[unlikely]]
      recorder.emplace(ToWorld<S>(pair.pose_a), stages, *record);
    step_in_order(pair, in_order, incremental, persistent, manifolds,
                  recorder ? &*recorder : nullptr);
  };
  work_in_order<S>(pair.a, pair.b, traded, options, manifolds, record, work);
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                    \
  template void collide_incremental(const Shape<S>&, const Pose<S>&, const Shape<S>&,  \
                                    const Pose<S>&, const CollideOptions<S>&,          \
                                    const IncrementalOptions&, PersistentManifold<S>&, \
                                    Manifolds<S>&, trace::Pair*, const trace::Stages&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
