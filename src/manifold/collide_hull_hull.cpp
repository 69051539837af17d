#include "manifold/collide_hull_hull.h"

#include "manifold/collide_by_penetration.h"
#include "manifold/create_contact.h"
#include "manifold/finish_contact.h"
#include "query/sat.h"

namespace contactscope {
namespace {

template <class S>
EdgeQueryRecord<S>* edge_query(Recorder<S>* recorder) {
  return recorder ? recorder->edge_query() : nullptr;
}

/// From what the separating axis test found.
template <class S>
void contact_of_axes(const HullPair<S>& pair, const SatResult<S>& axes,
                     const CollideOptions<S>& options, Contact<S>& contact, Recorder<S>* recorder) {
  if (recorder) [[unlikely]]
    recorder->axes(pair, axes, options.preference);
  if (axes.status != SatStatus::Touching) return;
  create_contact(pair, axes, options.margin, options.preference, contact, recorder);
  if (recorder) [[unlikely]]
    recorder->contact_axis(contact.axis);
}

}  // namespace

/// Gregorius 2015, SAT( manifold, hullA, hullB ).
template <class S>
S collide_hull_hull(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                    const CollideOptions<S>& options, Contact<S>& contact, Recorder<S>* recorder,
                    Owner preferred) {
  if (options.penetration != PenetrationMethod::Sat) [[unlikely]] {
    const auto separation = collide_by_penetration(a, b, b_in_a, options, contact, recorder);
    if (separation) return *separation;
  }
  const HullPair<S> pair(a, b, b_in_a);
  const SatResult<S> axes =
      sat(pair, options.margin, options.preference, preferred, edge_query(recorder));
  contact_of_axes(pair, axes, options, contact, recorder);
  return axes.separation(axes.chosen);
}

/// Gregorius 2015, "Hull vs Hull: Temporal Coherence".
template <class S>
S collide_hull_hull(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                    const CollideOptions<S>& options, PairCache<S>& cache, Contact<S>& contact,
                    Recorder<S>* recorder) {
  if (options.penetration != PenetrationMethod::Sat) [[unlikely]] {
    cache = PairCache<S>();  // what it keeps bounds the axes of the separating axis test
    return collide_hull_hull(a, b, b_in_a, options, contact, recorder);
  }
  const CacheAnswer<S> answer = collide_from_cache(a, b, b_in_a, options, cache, contact, recorder);
  if (recorder && answer.kind != CachedKind::Empty) [[unlikely]]
    recorder->cache(answer);
  if (answer.hit) return answer.separation;
  contact.points.clear();

  const HullPair<S> pair(a, b, b_in_a);
  FaceSeparations<S> faces_a(pair.a);
  FaceSeparations<S> faces_b(pair.b);
  const SatResult<S> axes = sat(pair, options.margin, options.preference, faces_a, faces_b,
                                Owner::A, edge_query(recorder));
  contact_of_axes(pair, axes, options, contact, recorder);
  cache = cache_of(pair, b_in_a, options, axes, faces_a, faces_b, contact);
  return axes.separation(axes.chosen);
}

template <class S>
Manifold<S> collide_hull_hull(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                              const Pose<S>& pose_b, const CollideOptions<S>& options,
                              PairCache<S>* cache) {
  Recorder<S>* const nobody = nullptr;
  Contact<S> contact;
  Manifold<S> manifold;
  const Pose<S> b_in_a = relative_pose(pose_a, pose_b);
  if (cache == nullptr)
    collide_hull_hull(a, b, b_in_a, options, contact, nobody);
  else
    collide_hull_hull(a, b, b_in_a, options, *cache, contact, nobody);
  finish_contact(ToWorld<S>(pose_a), options, contact, manifold, nobody);
  return manifold;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                         \
  template S collide_hull_hull(const Hull<S>&, const Hull<S>&, const Pose<S>&,              \
                               const CollideOptions<S>&, Contact<S>&, Recorder<S>*, Owner); \
  template S collide_hull_hull(const Hull<S>&, const Hull<S>&, const Pose<S>&,              \
                               const CollideOptions<S>&, PairCache<S>&, Contact<S>&,        \
                               Recorder<S>*);                                               \
  template Manifold<S> collide_hull_hull(const Hull<S>&, const Pose<S>&, const Hull<S>&,    \
                                         const Pose<S>&, const CollideOptions<S>&, PairCache<S>*);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
