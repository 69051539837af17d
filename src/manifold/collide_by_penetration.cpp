#include "manifold/collide_by_penetration.h"

#include "manifold/contact_from_normal.h"
#include "manifold/create_contact.h"
#include "query/penetration.h"

namespace contactscope {

template <class S>
std::optional<S> collide_by_penetration(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                                        const CollideOptions<S>& options, Contact<S>& contact,
                                        Recorder<S>* recorder) {
  const SupportSet<S> set_a = support_set(a), set_b = support_set(b);
  const GjkResult<S> query = gjk<S>(set_a, set_b, b_in_a, nullptr, gjk_run(recorder));
  if (recorder) [[unlikely]]
    recorder->gjk(Pose<S>());
  const bool overlap = may_overlap(query, set_a, set_b, b_in_a);
  if (!overlap && query.distance > options.margin) return query.distance;
  if (!overlap) return std::nullopt;

  const PenetrationResult<S> found = penetration<S>(options.penetration, set_a, set_b, b_in_a, {},
                                                    &query.simplex, penetration_steps(recorder));
  if (has_depth(found.status)) {
    const HullPair<S> pair(a, b, b_in_a);
    const SatResult<S> axes = axes_of_normal(pair, found.normal, found.depth, options.preference);
    if (axes.status == SatStatus::Touching) {
      if (recorder) [[unlikely]]
        recorder->penetration(options.penetration, found, nullptr);
      create_contact(pair, axes, options.margin, options.preference, contact, recorder);
      return axes.separation(axes.chosen);
    }
  }
  if (recorder) [[unlikely]]
    recorder->penetration(options.penetration, found, "sat");
  return std::nullopt;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                                \
  template std::optional<S> collide_by_penetration(const Hull<S>&, const Hull<S>&, const Pose<S>&, \
                                                   const CollideOptions<S>&, Contact<S>&,          \
                                                   Recorder<S>*);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
