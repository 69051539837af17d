#include "manifold/collide_pairs.h"
#include "manifold/create_contact.h"

namespace contactscope {

/// Gregorius 2015, SAT( manifold, hullA, hullB ), and "Hull vs Hull: Temporal Coherence".
template <class S>
S collide_hull_hull(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                    const CollideOptions& options, PairCache<S>* cache, Contact<S>& contact,
                    Recorder<S>* recorder, Owner preferred) {
  if (options.penetration != PenetrationMethod::Sat) [[unlikely]] {
    const auto separation = collide_by_penetration(a, b, b_in_a, options, contact, recorder);
    // The cache's bounds are for the axes of the separating axis test.
    if (cache) *cache = PairCache<S>();
    cache = nullptr;
    if (separation) return *separation;
  }
  if (cache) {
    const CacheAnswer<S> answer =
        collide_from_cache(a, b, b_in_a, options, *cache, contact, recorder);
    if (recorder && answer.kind != CachedKind::Empty) [[unlikely]]
      recorder->cache(answer);
    if (answer.hit) return answer.separation;
    contact.points.clear();
  }

  const HullPair<S> pair(a, b, b_in_a);
  if (cache == nullptr && recorder == nullptr) {
    const SatResult<S> axes =
        sat(pair, static_cast<S>(options.margin), options.preference, preferred);
    if (axes.status == SatStatus::Touching) create_contact(pair, axes, options, contact, recorder);
    return axes.separation(axes.chosen);
  }
  // The record contains every face; the cache bounds them all.
  FaceSeparations<S> faces_a(pair.a);
  FaceSeparations<S> faces_b(pair.b);
  const SatResult<S> axes =
      sat(pair, static_cast<S>(options.margin), options.preference, faces_a, faces_b, preferred);
  if (recorder) [[unlikely]] {
    recorder->axes(pair, faces_a, axes, options.preference);
    recorder->axis_decisions(pair, faces_a, faces_b, axes, options);
  }
  if (axes.status == SatStatus::Touching) {
    create_contact(pair, axes, options, contact, recorder);
    if (recorder) [[unlikely]]
      recorder->contact_axis(contact.axis);
  }
  if (cache) *cache = cache_of(pair, b_in_a, options, axes, faces_a, faces_b, contact);
  return axes.separation(axes.chosen);
}

template <class S>
Manifold<S> collide_hull_hull(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                              const Pose<S>& pose_b, const CollideOptions& options,
                              PairCache<S>* cache) {
  Recorder<S>* const no_record = nullptr;
  Contact<S> contact;
  Manifold<S> manifold;
  collide_hull_hull(a, b, relative_pose(pose_a, pose_b), options, cache, contact, no_record);
  finish_contact(ToWorld<S>(pose_a), options, contact, manifold, no_record);
  return manifold;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                             \
  template S collide_hull_hull(const Hull<S>&, const Hull<S>&, const Pose<S>&,                  \
                               const CollideOptions&, PairCache<S>*, Contact<S>&, Recorder<S>*, \
                               Owner);                                                          \
  template Manifold<S> collide_hull_hull(const Hull<S>&, const Pose<S>&, const Hull<S>&,        \
                                         const Pose<S>&, const CollideOptions&, PairCache<S>*);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
