#include "dynamics/solver.h"

#include "dynamics/integrate.h"
#include "dynamics/prepare.h"
#include "dynamics/projection.h"
#include "dynamics/solve_velocities.h"

namespace contactscope {
namespace {

template <class S>
std::vector<SolverBody<S>> solver_bodies(const std::vector<Body<S>>& bodies) {
  std::vector<SolverBody<S>> result(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    result[i].body = bodies[i];
    result[i].turn_inertia();
  }
  return result;
}

/// A sub-step begins without what the last one gave, unless that warms it.
template <class S>
void begin_substep(std::vector<ContactConstraint<S>>& contacts, bool keep) {
  for (ContactConstraint<S>& contact : contacts) {
    for (ConstraintPoint<S>& point : contact.points) {
      point.position_impulse = 0;
      if (!keep) point.normal_impulse = point.friction_u = point.friction_v = 0;
    }
  }
}

template <class S>
void end_substep(std::vector<ContactConstraint<S>>& contacts) {
  for (ContactConstraint<S>& contact : contacts) {
    for (ConstraintPoint<S>& point : contact.points) {
      point.total_normal += point.normal_impulse;
      point.total_u += point.friction_u;
      point.total_v += point.friction_v;
    }
  }
}

}  // namespace

template <class S>
void solve_step(std::vector<Body<S>>& bodies, std::span<const PairContacts<S>> pairs,
                std::vector<PairImpulses<S>>& impulses, const Vec3<S>& gravity,
                const SolverSettings& given, S dt) {
  const SolverSettings settings = settled(given, bodies);
  std::vector<SolverBody<S>> moving = solver_bodies(bodies);
  const std::span<SolverBody<S>> all(moving);
  impulses.resize(pairs.size());
  std::vector<ContactConstraint<S>> contacts = prepare_contacts<S>(all, pairs, impulses, settings);

  const S h = dt / static_cast<S>(settings.substeps);
  for (int substep = 0; substep < settings.substeps; ++substep) {
    for (SolverBody<S>& moved : moving)
      if (moved.body.dynamic()) moved.body.velocity += h * gravity;
    if (substep == 0) note_approach(all, contacts);
    update_separations(all, contacts);
    begin_substep(contacts, settings.warm_start);
    warm_start(all, contacts);
    for (int i = 0; i < settings.iterations; ++i)
      solve_velocities(all, contacts, settings, true, h);
    for (SolverBody<S>& body : moving) integrate_position(body, h);
    if (settings.position_correction == PositionCorrection::Soft) {
      // The spring's velocity has moved the bodies; what is left of it would carry them on.
      update_separations(all, contacts);
      for (int i = 0; i < settings.iterations; ++i)
        solve_velocities(all, contacts, settings, false, h);
    }
    if (settings.position_correction == PositionCorrection::Projection)
      for (int i = 0; i < settings.iterations; ++i) project_positions(all, contacts, settings);
    end_substep(contacts);
  }
  update_separations(all, contacts);
  for (int i = 0; i < settings.iterations; ++i) apply_restitution(all, contacts, gravity, h);

  for (PairImpulses<S>& kept : impulses) kept.clear();
  for (const ContactConstraint<S>& contact : contacts)
    keep_impulses(contact, impulses[static_cast<std::size_t>(contact.pair)]);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i] = moving[i].body;
    bodies[i].center += moving[i].moved;
  }
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                              \
  template void solve_step(std::vector<Body<S>>&, std::span<const PairContacts<S>>,              \
                           std::vector<PairImpulses<S>>&, const Vec3<S>&, const SolverSettings&, \
                           S);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
