#include <cmath>

#include "manifold/asked_pair.h"
#include "query/penetration.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// A convex shape as the points within `radius` of its core.
template <class S>
struct RoundedCore {
  SupportSet<S> set;
  S radius = 0;

  bool has_volume() const { return set.hull != nullptr; }
};

template <class S>
RoundedCore<S> rounded_core(const Shape<S>& shape) {
  static const Vec3<S> kMiddle = Vec3<S>::Zero();
  if (const auto* sphere = std::get_if<Sphere<S>>(&shape))
    return {support_set(kMiddle), sphere->radius};
  if (const auto* capsule = std::get_if<Capsule<S>>(&shape))
    return {{capsule->points.data(), 2, nullptr}, capsule->radius};
  return {support_set(std::get<Hull<S>>(shape)), S(0)};
}

/// See ask(): 64 epsilon. GJK and the separating axis test have been seen 36 epsilon apart, see
/// may_overlap().
template <class S>
S rounding_of(S lengths) {
  return depth_rounding(S(2) * lengths);
}

/// Whether it matters how deep cores are in each other that may overlap.
template <class S>
bool needs_depth(const Question& question, const GjkResult<S>& cores, S radii, S rounding) {
  switch (question.kind) {
    case QueryKind::Penetration:
      return true;
    case QueryKind::Touching:
      return radii <= static_cast<S>(question.tolerance) + rounding;
    case QueryKind::Overlap:  // Overlap of GJK is more than rounding
      return !question.inclusive && radii <= rounding && cores.status != GjkStatus::Overlap;
    default:
      return false;
  }
}

constexpr QueryMethod query_method(PenetrationMethod method) {
  return static_cast<QueryMethod>(static_cast<int>(QueryMethod::Sat) + static_cast<int>(method));
}
static_assert(query_method(PenetrationMethod::Sampling) == QueryMethod::Sampling);

}  // namespace

template <class S>
Gap<S> gap_of_cores(const Shape<S>& a, const Shape<S>& b, const Pose<S>& b_in_a,
                    const Question& question, Recorder<S>* recorder) {
  const RoundedCore<S> core_a = rounded_core(a), core_b = rounded_core(b);
  const S radii = core_a.radius + core_b.radius;
  Gap<S> found;
  found.rounding =
      rounding_of(reach_of(core_a.set) + reach_of(core_b.set) + b_in_a.position.norm() + radii);
  const GjkResult<S> cores = gjk<S>(core_a.set, core_b.set, b_in_a, nullptr, gjk_run(recorder));
  if (recorder) [[unlikely]]
    recorder->gjk(Pose<S>());
  const auto from_cores = [&](S distance, const Vec3<S>& normal, const Vec3<S>& on_a,
                              const Vec3<S>& on_b) {
    found.gap = distance - radii;
    found.normal = normal;
    found.on_a = on_a + core_a.radius * normal;
    found.on_b = on_b - core_b.radius * normal;
  };
  const bool any_volume = core_a.has_volume() || core_b.has_volume();
  if (any_volume && may_overlap(cores, core_a.set, core_b.set, b_in_a) &&
      needs_depth(question, cores, radii, found.rounding)) {
    const PenetrationMethod method =
        question.kind == QueryKind::Penetration ? question.penetration : PenetrationMethod::Sat;
    const PenetrationResult<S> deep = penetration<S>(method, core_a.set, core_b.set, b_in_a, {},
                                                     &cores.simplex, penetration_steps(recorder));
    if (recorder) [[unlikely]]
      recorder->penetration(method, deep, nullptr);
    if (has_depth(deep.status)) {
      found.method = query_method(method);
      from_cores(-deep.depth, deep.normal, deep.on_a, deep.on_b);
      return found;
    }
    // GJK has them touch, the other apart by a hair: within rounding of each other either way.
    found.gap = cores.distance - radii;
  }
  if (cores.status == GjkStatus::Separated) {
    from_cores(cores.distance, cores.normal, cores.on_a, cores.on_b);
  } else if (!any_volume) {
    found.gap = -radii;
  }
  return found;
}

template <class S>
Gap<S> gap_to_plane(const Shape<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a) {
  const RoundedCore<S> core = rounded_core(a);
  const Vec3<S> outward = b_in_a.rotate(b.plane.normal);
  const Vec3<S>& lowest = at(core.set.points, support_index<S>(core.set, -outward));
  Gap<S> found;
  found.method = QueryMethod::Support;
  found.rounding = rounding_of(reach_of(core.set) + b_in_a.position.norm() +
                               std::abs(b.plane.offset) + core.radius);
  found.normal = -outward;
  found.on_a = lowest - core.radius * outward;
  found.gap = outward.dot(found.on_a - b_in_a.position) - b.plane.offset;
  found.on_b = found.on_a - *found.gap * outward;
  return found;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                               \
  template Gap<S> gap_of_cores(const Shape<S>&, const Shape<S>&, const Pose<S>&, const Question&, \
                               Recorder<S>*);                                                     \
  template Gap<S> gap_to_plane(const Shape<S>&, const HalfSpace<S>&, const Pose<S>&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
