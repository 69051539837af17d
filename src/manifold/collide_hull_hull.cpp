#include "manifold/collide_hull_hull.h"

#include "manifold/collide_by_penetration.h"
#include "manifold/create_contact.h"
#include "manifold/finish_contact.h"
#include "manifold/recorder.h"
#include "query/sat.h"
#ifndef CONTACTSCOPE_WITHOUT_RECORDER
#include "manifold/trace_recorder.h"
#endif

namespace contactscope {

/// Gregorius 2015, SAT( manifold, hullA, hullB ).
template <class S, class Recorder>
S collide_hull_hull(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                    const CollideOptions<S>& options, Contact<S>& contact, Recorder& recorder,
                    Owner preferred) {
  if (options.penetration != PenetrationMethod::Sat) [[unlikely]] {
    return collide_by_penetration(a, b, b_in_a, options, contact, recorder);
  }
  const HullPair<S> pair(a, b, b_in_a);
  const SatResult<S> axes = sat(pair, options.margin, options.preference, preferred);
  recorder.axes(pair, axes, options.preference);
  if (axes.status == SatStatus::Touching) {
    create_contact(pair, axes, options.margin, options.preference, contact, recorder);
    recorder.contact_axis(contact.axis);
  }
  return axes.separation(axes.chosen);
}

/// Gregorius 2015, "Hull vs Hull: Temporal Coherence".
template <class S, class Recorder>
S collide_hull_hull(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                    const CollideOptions<S>& options, PairCache<S>& cache, Contact<S>& contact,
                    Recorder& recorder) {
  if (options.penetration != PenetrationMethod::Sat) [[unlikely]] {
    cache = PairCache<S>();  // what it keeps bounds the axes of the separating axis test
    return collide_by_penetration(a, b, b_in_a, options, contact, recorder);
  }
  const CacheAnswer<S> answer = collide_from_cache(a, b, b_in_a, options, cache, contact, recorder);
  if (answer.kind != CachedKind::Empty) recorder.cache(answer);
  if (answer.hit) return answer.separation;
  contact.points.clear();

  const HullPair<S> pair(a, b, b_in_a);
  FaceSeparations<S> faces_a(pair.a);
  FaceSeparations<S> faces_b(pair.b);
  const SatResult<S> axes = sat(pair, options.margin, options.preference, faces_a, faces_b);
  recorder.axes(pair, axes, options.preference);
  if (axes.status == SatStatus::Touching) {
    create_contact(pair, axes, options.margin, options.preference, contact, recorder);
    recorder.contact_axis(contact.axis);
  }
  cache = cache_of(pair, b_in_a, options, axes, faces_a, faces_b, contact);
  return axes.separation(axes.chosen);
}

template <class S>
Manifold<S> collide_hull_hull(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                              const Pose<S>& pose_b, const CollideOptions<S>& options) {
  NoRecorder<S> recorder;
  Contact<S> contact;
  Manifold<S> manifold;
  collide_hull_hull(a, b, relative_pose(pose_a, pose_b), options, contact, recorder);
  finish_contact(ToWorld<S>(pose_a), options, contact, manifold, recorder);
  return manifold;
}

template <class S>
Manifold<S> collide_hull_hull(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                              const Pose<S>& pose_b, const CollideOptions<S>& options,
                              PairCache<S>& cache) {
  NoRecorder<S> recorder;
  Contact<S> contact;
  Manifold<S> manifold;
  collide_hull_hull(a, b, relative_pose(pose_a, pose_b), options, cache, contact, recorder);
  finish_contact(ToWorld<S>(pose_a), options, contact, manifold, recorder);
  return manifold;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                      \
  template Manifold<S> collide_hull_hull(const Hull<S>&, const Pose<S>&, const Hull<S>&, \
                                         const Pose<S>&, const CollideOptions<S>&);      \
  template Manifold<S> collide_hull_hull(const Hull<S>&, const Pose<S>&, const Hull<S>&, \
                                         const Pose<S>&, const CollideOptions<S>&, PairCache<S>&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

#define CONTACTSCOPE_INSTANTIATE(S, Recorder)                                               \
  template S collide_hull_hull(const Hull<S>&, const Hull<S>&, const Pose<S>&,              \
                               const CollideOptions<S>&, Contact<S>&, Recorder<S>&, Owner); \
  template S collide_hull_hull(const Hull<S>&, const Hull<S>&, const Pose<S>&,              \
                               const CollideOptions<S>&, PairCache<S>&, Contact<S>&,        \
                               Recorder<S>&);
CONTACTSCOPE_INSTANTIATE(float, NoRecorder)
CONTACTSCOPE_INSTANTIATE(double, NoRecorder)
#ifndef CONTACTSCOPE_WITHOUT_RECORDER
CONTACTSCOPE_INSTANTIATE(float, TraceRecorder)
CONTACTSCOPE_INSTANTIATE(double, TraceRecorder)
#endif
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
