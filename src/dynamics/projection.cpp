#include "dynamics/projection.h"

#include <algorithm>

#include "dynamics/prepare.h"

namespace contactscope {
namespace {

/// Moves as `impulse` (kg m) at `arm` would in no time.
template <class S>
void displace(SolverBody<S>& moving, const Vec3<S>& impulse, const Vec3<S>& arm) {
  if (!moving.body.dynamic()) return;
  moving.moved += moving.body.inverse_mass * impulse;
  const Vec3<S> turn = S(0.5) * (moving.inverse_inertia_world * arm.cross(impulse));
  Quat<S>& rotation = moving.body.rotation;
  // The body keeps its angular momentum's place in the world, and turns under it by a trifle.
  rotation = Quat<S>(S(1), turn.x(), turn.y(), turn.z()) * rotation;
  rotation.normalize();
  moving.turn_inertia();
}

}  // namespace

template <class S>
void project_positions(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                       const SolverSettings& settings) {
  for (ContactConstraint<S>& contact : contacts) {
    SolverBody<S>& a = bodies[static_cast<std::size_t>(contact.a)];
    SolverBody<S>& b = bodies[static_cast<std::size_t>(contact.b)];
    for (ConstraintPoint<S>& point : contact.points) {
      const S error =
          separation_now(a, b, point, contact.normal) + static_cast<S>(settings.slop.value_or(0));
      const S whole = std::max(point.position_impulse - point.normal_mass * error, S(0));
      const S change = whole - point.position_impulse;
      point.position_impulse = whole;
      if (change == 0) continue;
      const Vec3<S> impulse = change * contact.normal;
      displace(a, Vec3<S>(-impulse), Vec3<S>(a.body.rotation * point.anchor_a));
      displace(b, impulse, Vec3<S>(b.body.rotation * point.anchor_b));
    }
  }
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                             \
  template void project_positions(std::span<SolverBody<S>>, std::vector<ContactConstraint<S>>&, \
                                  const SolverSettings&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
