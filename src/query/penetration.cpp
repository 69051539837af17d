#include "query/penetration.h"

#include "query/epa.h"
#include "query/mpr.h"
#include "query/sampling.h"
#include "query/sat_penetration.h"
#include "query/tolerance.h"

namespace contactscope {

const char* to_string(PenetrationStatus status) {
  switch (status) {
    case PenetrationStatus::Converged:
      return "converged";
    case PenetrationStatus::Flat:
      return "flat";
    case PenetrationStatus::Separated:
      return "separated";
    case PenetrationStatus::Stalled:
      return "stalled";
    case PenetrationStatus::OutOfIterations:
      return "out_of_iterations";
    case PenetrationStatus::NotFinite:
      return "not_finite";
  }
  return "?";
}

template <class S>
bool may_overlap(const GjkResult<S>& gjk, const SupportSet<S>& a, const SupportSet<S>& b,
                 const Pose<S>& b_in_a) {
  if (gjk.status == GjkStatus::Touching || gjk.status == GjkStatus::Overlap) return true;
  return gjk.distance <=
         depth_rounding(S(2) * (reach_of(a) + reach_of(b) + b_in_a.position.norm()));
}

template <class S>
PenetrationResult<S> penetration(PenetrationMethod method, const SupportSet<S>& a,
                                 const SupportSet<S>& b, const Pose<S>& b_in_a,
                                 const PenetrationOptions<S>& options, const GjkSimplex<S>* overlap,
                                 PenetrationSteps<S>* steps) {
  switch (method) {
    case PenetrationMethod::Epa:
      return epa(a, b, b_in_a, options, overlap, steps);
    case PenetrationMethod::Mpr:
      return mpr(a, b, b_in_a, options, steps);
    case PenetrationMethod::Sampling:
      return sampling(a, b, b_in_a, options, steps);
    case PenetrationMethod::Sat:
      break;
  }
  return sat_penetration(a, b, b_in_a);
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                          \
  template bool may_overlap(const GjkResult<S>&, const SupportSet<S>&, const SupportSet<S>&, \
                            const Pose<S>&);                                                 \
  template PenetrationResult<S> penetration(                                                 \
      PenetrationMethod, const SupportSet<S>&, const SupportSet<S>&, const Pose<S>&,         \
      const PenetrationOptions<S>&, const GjkSimplex<S>*, PenetrationSteps<S>*);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
