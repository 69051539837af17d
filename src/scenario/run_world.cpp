#include <algorithm>
#include <cmath>

#include "scenario/run.h"

// What the solver does in scenarios with dynamic shapes.

namespace contactscope {
namespace {

/// Velocity of a point of a body, by its arm from the centre.
template <class S>
Vec3d velocity_at(const Body<S>& body, const Vec3d& arm) {
  const Vec3d turning = body.angular_velocity.template cast<double>();
  return body.velocity.template cast<double>() + turning.cross(arm);
}

/// What became of a pair's points that got an impulse, where the step has gone from `before` to
/// `after`. The script of a body that is not dynamic is the same all through the step.
template <class S>
void record_relative_velocities(const ScenarioPair& pair, const std::vector<Body<S>>& before,
                                const std::vector<Body<S>>& after, trace::Pair& record) {
  const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
  const auto began = [&](std::size_t i) -> const Body<S>& {
    return before[i].dynamic() ? before[i] : after[i];
  };
  for (trace::Manifold& manifold : record.manifolds) {
    for (trace::Point& point : manifold.points) {
      if (!point.impulse) continue;
      const Vec3d arm_a = point.position - before[a].center.template cast<double>();
      const Vec3d arm_b = point.position - before[b].center.template cast<double>();
      point.relative_velocity =
          trace::RelativeVelocity{velocity_at(began(b), arm_b) - velocity_at(began(a), arm_a),
                                  velocity_at(after[b], arm_b) - velocity_at(after[a], arm_a)};
    }
  }
}

/// Impulses stand in the order of manifolds and points; a point that the solver left out has none.
template <class S>
void record_impulses(const Manifolds<S>& manifolds, const PairImpulses<S>& impulses,
                     trace::Pair& record) {
  std::size_t next = 0;
  for (std::size_t m = 0; m < manifolds.size(); ++m) {
    for (std::size_t p = 0; p < manifolds[m].points.size() && next < impulses.size(); ++p) {
      const PointImpulse<S>& impulse = impulses[next];
      if (impulse.id != manifolds[m].points[p].id || impulse.triangle != manifolds[m].triangle)
        continue;
      ++next;
      record.manifolds[m].points[p].impulse = trace::Impulse{
          static_cast<double>(impulse.total_normal), impulse.total_friction.template cast<double>(),
          static_cast<double>(impulse.warm_start)};
    }
  }
}

}  // namespace

template <class S>
trace::Solver Runner::solver_facts(const State<S>& state) const {
  const Scenario& scenario = *scenario_;
  trace::Solver facts;
  facts.position_correction = to_string(scenario.solver.position_correction);
  facts.iterations = scenario.solver.iterations;
  facts.substeps = scenario.solver.substeps;
  facts.warm_start = scenario.solver.warm_start;
  facts.slop = scenario.solver.slop.value_or(0);
  facts.speculative_margin = scenario.solver.speculative_margin.value_or(0);
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    const Body<S>& body = state.bodies[i];
    if (!body.dynamic()) continue;
    trace::Body& fact = facts.bodies.emplace_back();
    fact.name = scenario.shapes[i].name;
    fact.mass = static_cast<double>(body.mass);
    fact.center_of_mass = body.center.template cast<double>();
    fact.velocity = body.velocity.template cast<double>();
    fact.angular_velocity = body.angular_velocity.template cast<double>();
    fact.kinetic_energy = kinetic_energy(body);
    fact.potential_energy = potential_energy(body, scenario.world.gravity);
  }
  return facts;
}

template <class S>
void Runner::solve(State<S>& state, const std::vector<Manifolds<S>>& contacts,
                   const std::vector<std::size_t>& chosen, trace::Frame* result) const {
  const double now = state.frame * scenario_->dt, next = (state.frame + 1) * scenario_->dt;
  const std::vector<Body<S>> before = state.bodies;
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    const ScenarioShape& shape = scenario_->shapes[i];
    if (!shape.dynamic())
      set_scripted_velocity(state.bodies[i], collider_pose_at(shape, now),
                            collider_pose_at(shape, next), scenario_->dt);
  }
  std::vector<PairContacts<S>> pairs;
  for (std::size_t i = 0; i < scenario_->pairs.size(); ++i) {
    const ScenarioPair& pair = scenario_->pairs[i];
    const auto own = [&](std::optional<double> ScenarioShape::*coefficient, double otherwise) {
      return std::pair((scenario_->shape(pair.a).*coefficient).value_or(otherwise),
                       (scenario_->shape(pair.b).*coefficient).value_or(otherwise));
    };
    const auto friction = own(&ScenarioShape::friction, scenario_->world.friction);
    const auto restitution = own(&ScenarioShape::restitution, scenario_->world.restitution);
    pairs.push_back({pair.a, pair.b, acts_[i] ? &contacts[i] : nullptr,
                     static_cast<S>(std::sqrt(friction.first * friction.second)),
                     static_cast<S>(std::max(restitution.first, restitution.second))});
  }
  solve_step<S>(state.bodies, pairs, state.impulses, scenario_->world.gravity.cast<S>(),
                scenario_->solver, static_cast<S>(scenario_->dt));
  // A script knows where it is; steps would add up their rounding.
  for (std::size_t i = 0; i < state.bodies.size(); ++i)
    if (!scenario_->shapes[i].dynamic())
      state.bodies[i].place(collider_pose_at(scenario_->shapes[i], next).template cast<S>());
  for (std::size_t k = 0; result && k < chosen.size(); ++k) {
    const std::size_t i = chosen[k];
    record_impulses(contacts[i], state.impulses[i], result->pairs[k]);
    record_relative_velocities(scenario_->pairs[i], before, state.bodies, result->pairs[k]);
  }
}

#define CONTACTSCOPE_INSTANTIATE(S)                                        \
  template trace::Solver Runner::solver_facts(const State<S>&) const;      \
  template void Runner::solve(State<S>&, const std::vector<Manifolds<S>>&, \
                              const std::vector<std::size_t>&, trace::Frame*) const;
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
