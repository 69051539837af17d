#include "manifold/incremental.h"

#include "geometry/core_hull.h"
#include "manifold/incremental_step.h"
#include "manifold/recorder.h"

namespace contactscope {
namespace {

/// `core_margin`: for hulls, metres. Not for meshes.
template <class S> ShapeCore<S> core_of(const Shape<S>& shape, double core_margin) {
  ShapeCore<S> core;
  core.kind = kind_of(shape);
  core.points[0] = core.points[1] = Vec3<S>::Zero();
  if (const auto* sphere = std::get_if<Sphere<S>>(&shape)) {
    core.margin = sphere->radius;
  } else if (const auto* capsule = std::get_if<Capsule<S>>(&shape)) {
    core.margin = capsule->radius;
    core.points[0] = capsule->points[0];
    core.points[1] = capsule->points[1];
  } else if (const auto* hull = std::get_if<Hull<S>>(&shape)) {
    // The margin in the pipeline's scalar, so that the faces move by exactly this.
    const auto margin = static_cast<double>(static_cast<S>(core_margin));
    CoreHull moved = core_hull(hull_cast<double>(*hull), margin);
    core.hull = hull_cast<S>(moved.hull);
    core.margin = static_cast<S>(moved.margin);
    core.vertices = std::move(moved.vertices);
    core.edges = std::move(moved.edges);
    core.faces = std::move(moved.faces);
  } else if (const auto* half_space = std::get_if<HalfSpace<S>>(&shape)) {
    core.plane = half_space->plane;
  }
  return core;
}

/// A point replaced within this fraction of the breaking distance has not visibly moved.
constexpr double kSamePlace = 0.01;

/// Whether the previous position of a replaced point is distinguishable from its current one.
template <class S>
bool has_moved(const BrokenPoint<S>& old, const IncrementalStep<S>& step, double least) {
  for (const StandingPoint<S>& point : step.points) {
    if (point.kept.id != old.point.kept.id) continue;
    const Vec3<S> offset = point.position() - old.point.position();
    return static_cast<double>(offset.norm()) > least;
  }
  return true;
}

/// By the features that meet at a single point; of several, by whether they form a line or a plane.
template <class S> ContactType type_of(const IncrementalStep<S>& step) {
  if (step.points.size() > 1) return face_contact_type(step.points.size());
  const PersistentContact<S>& only = step.points[0].kept;
  return contact_type(only.of_a.kind, only.of_b.kind);
}

/// Step 4, in the world. Kept points keep their order. `scale` as in CoreQuery.
template <class S>
void reduce_points(const CollideOptions& options, S scale, Manifold<S>& manifold,
                   IncrementalStep<S>& step, Recorder<S>* recorder) {
  const ContactPoints<S> points(manifold.points.data(), manifold.points.size());
  const ReduceOptions reduction = options.reduction_at(scale);
  KeptIndices kept;
  if (options.reducer != nullptr) {
    kept = recorder ? recorder->reduce(options.reducer, points, manifold.normal, reduction)
                    : reduce(options.reducer, points, manifold.normal, reduction);
  } else {
    const int oldest = std::max(0, count_of(points) - static_cast<int>(kMaxPersistentPoints));
    for (int i = oldest; i < count_of(points); ++i) kept.push_back(i);
  }
  std::size_t place = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::ranges::find(kept, static_cast<int>(i)) != kept.end()) {
      manifold.points[place] = manifold.points[i];
      step.points[place++] = step.points[i];
    } else if (step.broken.size() < step.broken.capacity()) {
      step.broken.push_back({step.points[i], "reduced"});
    }
  }
  manifold.points.truncate(place);
  step.points.truncate(place);
}

/// One frame. Makes no manifold if the query has no result.
template <class S>
void step_in_order(const PlacedPair<S>& pair, const CollideOptions& options,
                   const IncrementalOptions& incremental, PersistentManifold<S>& persistent,
                   Manifolds<S>& manifolds, Recorder<S>* recorder) {
  manifolds.clear();
  if (!can_persist(kind_of(pair.a), kind_of(pair.b))) return;
  if (persistent.core_a == nullptr) {
    const double margin = incremental.settings.core_margin;
    persistent.core_a = std::make_shared<const ShapeCore<S>>(core_of(pair.a, margin));
    persistent.core_b = std::make_shared<const ShapeCore<S>>(core_of(pair.b, margin));
  }
  const Pose<S> b_in_a = relative_pose(pair.pose_a, pair.pose_b);
  const ShapeCore<S>&a = *persistent.core_a, &b = *persistent.core_b;
  const PenetrationMethod method = incremental.penetration;
  const auto query =
      query_cores(a, b, b_in_a, method, gjk_run(recorder), penetration_steps(recorder));
  if (recorder) [[unlikely]]
    recorder->gjk(Pose<S>());
  if (!query) {
    persistent.points.clear();
    return;
  }
  // The separating axis test has its own record, of the shapes' features instead of the cores'.
  if (recorder && query->overlap && method != PenetrationMethod::Sat) [[unlikely]]
    recorder->penetration(method, query->deep, nullptr);
  const S separation = query->distance - (a.margin + b.margin);
  if (recorder) [[unlikely]]
    recorder->separation(separation);
  IncrementalStep<S> step;
  confirm_points(persistent, b_in_a, *query, incremental.settings, static_cast<S>(options.margin),
                 step);
  if (separation <= options.margin)
    add_point(persistent, b_in_a, *query, incremental.settings, step);

  if (!step.points.empty()) {
    const ToWorld<S> to_world(pair.pose_a);
    Manifold<S>& manifold = manifolds.emplace_back();
    manifold.normal = to_world.direction(query->normal);
    manifold.axis = query->axis;
    for (const StandingPoint<S>& point : step.points)
      manifold.points.push_back(
          {to_world.point(point.position()), point.separation, point.kept.id});
    reduce_points(options, query->scale, manifold, step, recorder);
    if (!step.points.empty()) manifold.type = type_of(step);
  }
  persistent.points.clear();
  for (const StandingPoint<S>& point : step.points) persistent.points.push_back(point.kept);
  if (recorder) [[unlikely]]
    recorder->incremental(*query, step, persistent, incremental);
}

}  // namespace

template <class S>
void Recorder<S>::incremental(const CoreQuery<S>& query, const IncrementalStep<S>& step,
                              const PersistentManifold<S>& persistent,
                              const IncrementalOptions& options) {
  trace::Incremental& recorded = pair_.incremental.emplace();
  recorded.confirm = to_string(options.settings.confirm);
  recorded.query = persistent.core_b->kind == ShapeKind::Plane ? "plane"
                   : query.overlap                             ? to_string(options.penetration)
                                                               : "gjk";
  recorded.margin_a = static_cast<double>(persistent.core_a->margin);
  recorded.margin_b = static_cast<double>(persistent.core_b->margin);
  if (options.settings.too_close == TooClose::Reject)
    recorded.rejects_within = options.settings.breaking_distance;
  const auto report = [&](const StandingPoint<S>& standing, const char* state, const char* reason) {
    trace::PersistentPoint& persists = recorded.points.emplace_back();
    persists.point = {point(standing.position()), static_cast<double>(standing.separation),
                      to_string(standing.kept.id)};
    persists.point.on_a = point(standing.on_a);
    persists.point.on_b = point(standing.on_b);
    persists.state = state;
    persists.reason = reason;
    persists.age = standing.kept.age;
  };
  for (const StandingPoint<S>& standing : step.points)
    report(standing, standing.is_new ? "new" : "persisted", "");
  const double least = kSamePlace * options.settings.breaking_distance;
  for (const BrokenPoint<S>& broken : step.broken) {
    const bool replaced = broken.reason == std::string_view("replaced");
    if (!replaced || has_moved(broken, step, least)) report(broken.point, "broken", broken.reason);
  }
}

bool can_persist(ShapeKind one, ShapeKind other) {
  return std::max(one, other) < ShapeKind::Mesh && can_collide(one, other);
}

template <class S>
void collide_incremental(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                         const Pose<S>& pose_b, const CollideOptions& options,
                         const IncrementalOptions& incremental, PersistentManifold<S>& persistent,
                         Manifolds<S>& manifolds, trace::Pair* record,
                         const trace::Stages& stages) {
  // Sizes and poses do not matter: the order must not change as long as the pair exists.
  const bool swapped = kind_of(a) == kind_of(b) ? options.b_first : kind_of(a) > kind_of(b);
  const auto work = [&](const PlacedPair<S>& pair, const CollideOptions& in_order) {
    std::optional<Recorder<S>> recorder;
    if (record != nullptr) [[unlikely]]
      recorder.emplace(ToWorld<S>(pair.pose_a), stages, *record);
    step_in_order(pair, in_order, incremental, persistent, manifolds,
                  recorder ? &*recorder : nullptr);
  };
  work_in_order<S>({a, pose_a, b, pose_b}, swapped, options, manifolds, record, work);
}

template void Recorder<float>::incremental(const CoreQuery<float>&, const IncrementalStep<float>&,
                                           const PersistentManifold<float>&,
                                           const IncrementalOptions&);
template void Recorder<double>::incremental(const CoreQuery<double>&,
                                            const IncrementalStep<double>&,
                                            const PersistentManifold<double>&,
                                            const IncrementalOptions&);
CONTACTSCOPE_FLOAT_AND_DOUBLE(collide_incremental);

}  // namespace contactscope
