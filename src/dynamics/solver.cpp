#include "dynamics/solver.h"

#include "dynamics/integrate.h"
#include "dynamics/projection.h"
#include "dynamics/solve_velocities.h"

namespace contactscope {
namespace {

template <class S>
std::vector<SolverBody<S>> solver_bodies(const std::vector<Body<S>>& bodies) {
  std::vector<SolverBody<S>> moving;
  for (const Body<S>& body : bodies) moving.push_back({body});
  for (SolverBody<S>& body : moving) body.turn_inertia();
  return moving;
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
    for_each_point(all, contacts, [&](const auto& pair, const auto& contact, auto& point) {
      if (substep == 0) point.approach = pair.velocity_at(point).dot(contact.normal);
      /// A sub-step begins without what the last one gave, unless that warms it.
      point.position_impulse = 0;
      if (!settings.warm_start) point.normal_impulse = point.friction_u = point.friction_v = 0;
    });
    update_separations(all, contacts);
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
    for_each_point(all, contacts, [](const auto&, const auto&, auto& point) {
      point.total_normal += point.normal_impulse;
      point.total_u += point.friction_u;
      point.total_v += point.friction_v;
    });
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

template <class S>
void solve_impact(std::vector<Body<S>>& bodies, std::span<const PairContacts<S>> pairs,
                  const SolverSettings& given, S dt) {
  SolverSettings settings = settled(given, bodies);
  settings.substeps = 1;
  std::vector<SolverBody<S>> moving = solver_bodies(bodies);
  const std::span<SolverBody<S>> all(moving);
  const std::vector<PairImpulses<S>> none(pairs.size());
  std::vector<ContactConstraint<S>> contacts = prepare_contacts<S>(all, pairs, none, settings);
  for_each_point(all, contacts, [](const auto& pair, const auto& contact, auto& point) {
    point.approach = pair.velocity_at(point).dot(contact.normal);
  });
  update_separations(all, contacts);
  for (const bool pushes_out : {true, false}) {
    if (!pushes_out && settings.position_correction != PositionCorrection::Soft) break;
    for (int i = 0; i < settings.iterations; ++i)
      solve_velocities(all, contacts, settings, pushes_out, dt);
  }
  for_each_point(all, contacts, [](const auto&, const auto&, auto& point) {
    point.total_normal += point.normal_impulse;
  });
  for (int i = 0; i < settings.iterations; ++i)
    apply_restitution<S>(all, contacts, Vec3<S>::Zero(), dt);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].velocity = moving[i].body.velocity;
    bodies[i].angular_velocity = moving[i].body.angular_velocity;
  }
}

template decltype(solve_impact<float>) solve_impact<float>;
template decltype(solve_impact<double>) solve_impact<double>;
template decltype(solve_step<float>) solve_step<float>;
template decltype(solve_step<double>) solve_step<double>;

}  // namespace contactscope
