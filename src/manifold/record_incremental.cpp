#include "manifold/incremental_step.h"
#include "manifold/recorder.h"

namespace contactscope {
namespace {

/// Replaced by a place this near, as a part of the breaking distance, a point has not moved for any
/// eye.
constexpr double kSamePlace = 0.01;

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
void Recorder<S>::incremental(const CoreQuery<S>& query, const IncrementalStep<S>& step,
                              const PersistentManifold<S>& persistent,
                              const IncrementalOptions& options) {
  trace::Incremental& told = pair_.incremental.emplace();
  told.confirm = to_string(options.settings.confirm);
  told.query = persistent.core_b->kind == ShapeKind::Plane ? "plane"
               : query.overlap                             ? to_string(options.penetration)
                                                           : "gjk";
  told.margin_a = static_cast<double>(persistent.core_a->margin);
  told.margin_b = static_cast<double>(persistent.core_b->margin);
  const auto tell = [&](const StandingPoint<S>& standing, const char* state, const char* reason) {
    trace::PersistentPoint& persists = told.points.emplace_back();
    persists.point = {point(standing.position()), static_cast<double>(standing.separation),
                      to_string(standing.kept.id)};
    persists.on_a = point(standing.on_a);
    persists.on_b = point(standing.on_b);
    persists.state = state;
    persists.reason = reason;
    persists.age = standing.kept.age;
  };
  for (const StandingPoint<S>& standing : step.points)
    tell(standing, standing.is_new ? "new" : "persisted", "");
  const double least = kSamePlace * options.settings.breaking_distance;
  for (const BrokenPoint<S>& broken : step.broken) {
    const bool replaced = broken.reason == std::string_view("replaced");
    if (!replaced || has_moved(broken, step, least)) tell(broken.point, "broken", broken.reason);
  }
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                      \
  template void Recorder<S>::incremental(const CoreQuery<S>&, const IncrementalStep<S>&, \
                                         const PersistentManifold<S>&, const IncrementalOptions&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
