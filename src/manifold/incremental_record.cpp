#include "manifold/incremental_record.h"

#include <utility>

namespace contactscope {
namespace {

/// Replaced by a place this near, as a part of the breaking distance, a point has not moved for any
/// eye.
constexpr double kSamePlace = 0.01;

template <class S>
trace::PersistentPoint told_point(const ToWorld<S>& to_world, const StandingPoint<S>& point,
                                  bool mirrored) {
  trace::PersistentPoint told;
  const FeatureId& id = point.kept.id;
  told.point = {to_world.point(point.position()).template cast<double>(),
                static_cast<double>(point.separation), to_string(mirrored ? id.flipped() : id)};
  told.on_a = to_world.point(point.on_a).template cast<double>();
  told.on_b = to_world.point(point.on_b).template cast<double>();
  if (mirrored) std::swap(told.on_a, told.on_b);
  told.age = point.kept.age;
  return told;
}

/// Whether the place that a replaced point had can be told from the one that it has now.
template <class S>
bool has_moved(const BrokenPoint<S>& old, const IncrementalStep<S>& step, double least) {
  for (const StandingPoint<S>& point : step.points) {
    if (point.kept.id != old.point.kept.id) continue;
    const Vec3<S> way = point.position() - old.point.position();
    return static_cast<double>(way.norm()) > least;
  }
  return true;
}

}  // namespace

template <class S>
trace::Incremental told_step(const ToWorld<S>& to_world, const CoreQuery<S>& query,
                             const IncrementalStep<S>& step,
                             const PersistentManifold<S>& persistent,
                             const IncrementalOptions& options, bool mirrored) {
  trace::Incremental told;
  told.confirm = to_string(options.settings.confirm);
  told.query = persistent.core_b->kind == ShapeKind::Plane ? "plane"
               : query.overlap                             ? to_string(options.penetration)
                                                           : "gjk";
  told.margin_a = static_cast<double>(persistent.core_a->margin);
  told.margin_b = static_cast<double>(persistent.core_b->margin);
  if (mirrored) std::swap(told.margin_a, told.margin_b);
  for (const StandingPoint<S>& point : step.points) {
    told.points.push_back(told_point(to_world, point, mirrored));
    told.points.back().state = point.is_new ? "new" : "persisted";
  }
  const double least = kSamePlace * options.settings.breaking_distance;
  for (const BrokenPoint<S>& broken : step.broken) {
    const bool replaced = broken.reason == std::string_view("replaced");
    if (replaced && !has_moved(broken, step, least)) continue;
    told.points.push_back(told_point(to_world, broken.point, mirrored));
    told.points.back().state = "broken";
    told.points.back().reason = broken.reason;
  }
  return told;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                              \
  template trace::Incremental told_step(const ToWorld<S>&, const CoreQuery<S>&,                  \
                                        const IncrementalStep<S>&, const PersistentManifold<S>&, \
                                        const IncrementalOptions&, bool);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
