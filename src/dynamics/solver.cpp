#include "dynamics/solver.h"

#include "dynamics/bounce.h"
#include "dynamics/integrate.h"

namespace contactscope {
namespace {

template <class S> std::vector<SolverBody<S>> solver_bodies(const std::vector<Body<S>>& bodies) {
  std::vector<SolverBody<S>> moving;
  for (const Body<S>& body : bodies) moving.push_back({body});
  for (SolverBody<S>& body : moving) body.turn_inertia();
  return moving;
}

/// Push speed of soft contacts, m/s: a quarter of the speed after a fall from half of the smallest
/// edge. The error of the sweeps, up to a third of it, is then less than a hundredth of the energy
/// of that body. Without gravity there is no such measure.
template <class S> double soft_push_speed(double gravity, const std::vector<Body<S>>& bodies) {
  return gravity > 0 ? 0.25 * std::sqrt(gravity * smallest_edge(bodies))
                     : std::numeric_limits<double>::infinity();
}

}  // namespace

template <class S>
void solve_step(std::vector<Body<S>>& bodies, std::span<const PairContacts<S>> pairs,
                std::vector<PairImpulses<S>>& impulses, const Vec3<S>& gravity,
                const SolverSettings& given, S dt) {
  SolverSettings settings = settled(given, bodies);
  if (settings.position_correction == PositionCorrection::Soft)
    settings.push_speed = soft_push_speed(static_cast<double>(gravity.norm()), bodies);
  std::vector<SolverBody<S>> moving = solver_bodies(bodies);
  const std::span<SolverBody<S>> all(moving);
  impulses.resize(pairs.size());
  std::vector<ContactConstraint<S>> contacts = prepare_contacts<S>(all, pairs, impulses, settings);

  const S h = dt / static_cast<S>(settings.substeps);
  for (int substep = 0; substep < settings.substeps; ++substep) {
    for (SolverBody<S>& moved : moving)
      if (moved.body.dynamic()) moved.body.velocity += h * gravity;
    for_each_point(all, contacts, [&](const auto&, const auto&, auto& point) {
      /// Impulses of the last sub-step are kept only for warm starting.
      point.position_impulse = 0;
      if (!settings.warm_start) point.normal_impulse = point.friction_u = point.friction_v = 0;
    });
    for (ContactConstraint<S>& contact : contacts) follow(BodyPair<S>(all, contact), contact);
    update_separations(all, contacts);
    note_approach(all, contacts);
    warm_start(all, contacts);
    for (int i = 0; i < settings.iterations; ++i)
      solve_velocities(all, contacts, settings, true, h);
    bounce(all, contacts, settings, gravity, h);
    for (SolverBody<S>& body : moving) integrate_position(body, h);
    correct_positions(all, contacts, settings, h);
    if (settings.position_correction == PositionCorrection::Soft) relax(all, contacts, settings, h);
    for_each_point(all, contacts, [](const auto&, const auto&, auto& point) {
      point.total_normal += point.normal_impulse;
      point.total_u += point.friction_u;
      point.total_v += point.friction_v;
    });
    end_bounces(all, contacts);
  }

  for (PairImpulses<S>& kept : impulses) kept.clear();
  for (const ContactConstraint<S>& contact : contacts)
    keep_impulses(contact, impulses[static_cast<std::size_t>(contact.pair)]);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i] = moving[i].body;
    bodies[i].center += moving[i].moved;
  }
}

template <class S>
void solve_impact(std::vector<Body<S>>& bodies, std::span<const PairContacts<S>> pairs,
                  const SolverSettings& given, S dt) {
  SolverSettings settings = settled(given, bodies);
  settings.substeps = 1;
  settings.position_correction = PositionCorrection::Projection;  // velocities reduce no overlap
  std::vector<SolverBody<S>> moving = solver_bodies(bodies);
  const std::span<SolverBody<S>> all(moving);
  const std::vector<PairImpulses<S>> none(pairs.size());
  std::vector<ContactConstraint<S>> contacts = prepare_contacts<S>(all, pairs, none, settings);
  note_approach(all, contacts);
  for (int i = 0; i < settings.iterations; ++i) solve_velocities(all, contacts, settings, true, dt);
  bounce<S>(all, contacts, settings, Vec3<S>::Zero(), dt);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].velocity = moving[i].body.velocity;
    bodies[i].angular_velocity = moving[i].body.angular_velocity;
  }
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(solve_impact, solve_step);

}  // namespace contactscope
