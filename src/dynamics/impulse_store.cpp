#include "dynamics/impulse_store.h"

namespace contactscope {

template <class S>
void recall_impulses(const PairImpulses<S>& kept, ContactConstraint<S>& contact, int substeps) {
  std::vector<bool> taken(kept.size(), false);
  for (ConstraintPoint<S>& point : contact.points) {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const PointImpulse<S>& before = kept[i];
      if (taken[i] || before.id != point.id || before.triangle != point.triangle) continue;
      taken[i] = true;
      point.normal_impulse = before.normal;
      point.friction_u = before.friction.dot(contact.tangent_u);
      point.friction_v = before.friction.dot(contact.tangent_v);
      point.warm_start = static_cast<S>(substeps) * before.normal;
      break;
    }
  }
}

template <class S>
void keep_impulses(const ContactConstraint<S>& contact, PairImpulses<S>& kept) {
  for (const ConstraintPoint<S>& point : contact.points) {
    PointImpulse<S>& impulse = kept.emplace_back();
    impulse.triangle = point.triangle;
    impulse.id = point.id;
    impulse.normal = point.normal_impulse;
    impulse.friction = point.friction_u * contact.tangent_u + point.friction_v * contact.tangent_v;
    impulse.total_normal = point.total_normal;
    impulse.total_friction = point.total_u * contact.tangent_u + point.total_v * contact.tangent_v;
    impulse.warm_start = point.warm_start;
  }
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                  \
  template void recall_impulses(const PairImpulses<S>&, ContactConstraint<S>&, int); \
  template void keep_impulses(const ContactConstraint<S>&, PairImpulses<S>&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
