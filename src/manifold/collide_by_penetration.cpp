#include "manifold/collide_by_penetration.h"

#include "manifold/contact_from_normal.h"
#include "manifold/create_contact.h"
#include "manifold/recorder.h"
#include "query/penetration.h"
#ifndef CONTACTSCOPE_WITHOUT_RECORDER
#include "manifold/trace_recorder.h"
#endif

namespace contactscope {
namespace {

template <class S, class Recorder>
S collide_by_sat(const HullPair<S>& pair, const CollideOptions<S>& options, Contact<S>& contact,
                 Recorder& recorder) {
  const SatResult<S> axes = sat(pair, options.margin, options.preference);
  recorder.axes(pair, axes, options.preference);
  if (axes.status == SatStatus::Touching) {
    create_contact(pair, axes, options.margin, options.preference, contact, recorder);
    recorder.contact_axis(contact.axis);
  }
  return axes.separation(axes.chosen);
}

}  // namespace

template <class S, class Recorder>
S collide_by_penetration(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                         const CollideOptions<S>& options, Contact<S>& contact,
                         Recorder& recorder) {
  const SupportSet<S> set_a = support_set(a), set_b = support_set(b);
  const GjkResult<S> query = gjk<S>(set_a, set_b, b_in_a, nullptr, recorder.gjk_run());
  recorder.gjk(Pose<S>());
  const bool overlap = may_overlap(query, set_a, set_b, b_in_a);
  if (!overlap && query.distance > options.margin) return query.distance;
  const HullPair<S> pair(a, b, b_in_a);
  if (!overlap) return collide_by_sat(pair, options, contact, recorder);

  const PenetrationResult<S> found = penetration<S>(options.penetration, set_a, set_b, b_in_a, {},
                                                    &query.simplex, recorder.penetration_steps());
  if (has_depth(found.status)) {
    const SatResult<S> axes = axes_of_normal(pair, found.normal, found.depth, options.preference);
    if (axes.status == SatStatus::Touching) {
      recorder.penetration(options.penetration, found, nullptr);
      create_contact(pair, axes, options.margin, options.preference, contact, recorder);
      return axes.separation(axes.chosen);
    }
  }
  recorder.penetration(options.penetration, found, "sat");
  return collide_by_sat(pair, options, contact, recorder);
}

#define CONTACTSCOPE_INSTANTIATE(S, Recorder)                                       \
  template S collide_by_penetration(const Hull<S>&, const Hull<S>&, const Pose<S>&, \
                                    const CollideOptions<S>&, Contact<S>&, Recorder<S>&);
CONTACTSCOPE_INSTANTIATE(float, NoRecorder)
CONTACTSCOPE_INSTANTIATE(double, NoRecorder)
#ifndef CONTACTSCOPE_WITHOUT_RECORDER
CONTACTSCOPE_INSTANTIATE(float, TraceRecorder)
CONTACTSCOPE_INSTANTIATE(double, TraceRecorder)
#endif
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
