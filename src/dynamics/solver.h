#pragma once

#include "dynamics/continuous_step.h"
#include "manifold/dispatch.h"

namespace contactscope {

/// Contacts that the pipeline found for one pair of bodies.
template <class S> struct PairContacts {
  int a = 0, b = 0;                         // bodies; normals point from a to b
  const Manifolds<S>* manifolds = nullptr;  // nullptr: none
  S friction = 0;                           // Coulomb's coefficient of the pair
  S restitution = 0;                        // of the pair
  // Radius of a sphere or capsule, metres; 0 for other shapes.
  S round_a = 0, round_b = 0;
  // Metres: points with a larger separation count only if they are met head-on.
  S margin = std::numeric_limits<S>::infinity();
};

/// Radius of a sphere or capsule, metres; 0 for other shapes.
template <class S> S round_radius(const Shape<S>& shape) {
  if (const auto* sphere = std::get_if<Sphere<S>>(&shape)) return sphere->radius;
  const auto* capsule = std::get_if<Capsule<S>>(&shape);
  return capsule != nullptr ? capsule->radius : S(0);
}

/// Impulses of one point in the last step. On b, newton seconds, world.
template <class S> struct PointImpulse {
  int triangle = -1;  // of a mesh; ids count within it
  FeatureId id;
  S normal = 0;  // of the last sub-step: the next one starts with it
  Vec3<S> friction = Vec3<S>::Zero();
  S total_normal = 0;  // over the whole step
  Vec3<S> total_friction = Vec3<S>::Zero();
  S warm_start = 0;  // share of total_normal that it started with
};

/// Impulses of one pair, in the order of its manifolds and their points.
template <class S> using PairImpulses = std::vector<PointImpulse<S>>;

/// The smallest shortest_edge() of all dynamic bodies, metres; 0 if there are none.
template <class S> double smallest_edge(const std::vector<Body<S>>& bodies) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Body<S>& body : bodies) {
    if (!body.dynamic()) continue;
    const Mat3<double> inertia = body.inertia.template cast<double>();
    smallest = std::min(smallest, shortest_edge(static_cast<double>(body.mass), inertia));
  }
  return smallest < std::numeric_limits<double>::infinity() ? smallest : 0;
}

/// Fills missing lengths from the smallest_edge(); see solver_settings.h.
template <class S>
SolverSettings settled(const SolverSettings& settings, const std::vector<Body<S>>& bodies) {
  if (settings.slop && settings.speculative_margin && settings.sleep_speed) return settings;
  return settled(settings, smallest_edge(bodies));
}

/// Moves `bodies` by `dt` seconds (> 0) so that the contacts hold. `pairs`: contacts at the current
/// poses. `impulses` (one per pair): the points' impulses of the previous step before the call, of
/// this step after it, in the order of manifolds and points. Gravity in m/s^2. Calls settled().
///
/// Contacts are found once, at the beginning. Between sub-steps their anchors move with the bodies;
/// only the normals of two round shapes turn. Deterministic: the same input gives the same bits.
template <class S>
void solve_step(std::vector<Body<S>>& bodies, std::span<const PairContacts<S>> pairs,
                std::vector<PairImpulses<S>>& impulses, const Vec3<S>& gravity,
                const SolverSettings& settings, S dt);

/// Applies the contacts of bodies that meet within a step of `dt` seconds to their velocities. Does
/// not move bodies, apply gravity or keep impulses: the pairs' own step has done that.
template <class S>
void solve_impact(std::vector<Body<S>>& bodies, std::span<const PairContacts<S>> pairs,
                  const SolverSettings& settings, S dt);

/// Two bodies that may touch, and the data kept for them between steps.
template <class S> struct WorldPair {
  int a = 0, b = 0;
  S friction = S(0.6);
  S restitution = 0;
  PairCache<S> cache{};
  std::optional<ImpactMethod> continuous{};  // nullopt: motion between frames is not checked
};

/// Everything that moves. A copy is a snapshot, and continues like the original.
template <class S> struct World {
  Vec3<S> gravity = Vec3<S>(S(0), S(-9.81), S(0));  // metres per second squared
  std::vector<Body<S>> bodies;
  std::vector<WorldPair<S>> pairs;
  std::vector<PairImpulses<S>> impulses;  // of the last step, one per pair
  std::vector<ImpactCore> cores;          // of continuous pairs, made by the first step
  CollideOptions contacts{};              // of every pair; the margin is the solver's
};

/// Bound of the pair's approach in `dt` seconds by its current motion and gravity, metres.
template <class S>
double speculative_reach(const World<S>& world, const std::vector<Shape<S>>& shapes,
                         const WorldPair<S>& pair, S dt) {
  const auto sweep = [&](int i) {
    Sweep<S> going = sweep_of(at(world.bodies, i), dt);
    if (at(world.bodies, i).dynamic()) going.displacement += dt * dt * world.gravity;
    return going;
  };
  return static_cast<double>(
      largest_approach(at(shapes, pair.a), sweep(pair.a), at(shapes, pair.b), sweep(pair.b)));
}

/// Separation, metres, up to which points of two bodies are found that can approach by `reach`() in
/// the step. `settings` are settled(). Contacts are found once per step. With sub-steps this
/// includes points that are met in later ones, up to half of the smallest body away if the margin
/// is not given. Faster bodies need continuous pairs.
template <class Reach> double contact_margin(const SolverSettings& settings, const Reach& reach) {
  constexpr double kMaxMargins = 25;
  const double margin = settings.speculative_margin.value_or(0);
  if (settings.substeps == 1 || margin == 0) return margin;
  return std::clamp(static_cast<double>(reach()), margin, kMaxMargins * margin);
}

/// PairContacts::margin for points within contact_margin(). `margin`: without sub-steps, metres.
template <class S>
S head_on_margin(const SolverSettings& settings, bool is_speculative, double margin) {
  const bool looks_farther = settings.substeps > 1 && !is_speculative;
  return looks_farther ? static_cast<S>(margin) : std::numeric_limits<S>::infinity();
}

/// Contacts at the current poses, one entry per pair; `shapes` has one per body. Keeps points up to
/// the contact_margin(); for a speculative pair up to what `dt` seconds can close.
template <class S>
void find_contacts(World<S>& world, const std::vector<Shape<S>>& shapes,
                   const SolverSettings& settings, std::vector<Manifolds<S>>& contacts, S dt = 0) {
  contacts.resize(world.pairs.size());
  CollideOptions options = world.contacts;
  const SolverSettings all = settled(settings, world.bodies);
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    WorldPair<S>& pair = world.pairs[i];
    const auto reach = [&] { return speculative_reach(world, shapes, pair, dt); };
    options.margin = pair.continuous == ImpactMethod::Speculative
                         ? std::max(*all.speculative_margin, reach())
                         : contact_margin(all, reach);
    options.margin = static_cast<S>(options.margin);
    collide(at(shapes, pair.a), at(world.bodies, pair.a).pose(), at(shapes, pair.b),
            at(world.bodies, pair.b).pose(), options, contacts[i], &pair.cache);
  }
}

/// find_contacts, solve_step, then stop_at_impacts for continuous pairs: `dt` seconds. `contacts`
/// stay available to the caller. Returns the stops.
template <class S>
std::vector<ImpactStop<S>> step(World<S>& world, const std::vector<Shape<S>>& shapes,
                                const SolverSettings& settings, S dt,
                                std::vector<Manifolds<S>>& contacts) {
  find_contacts(world, shapes, settings, contacts, dt);
  const double margin = *settled(settings, world.bodies).speculative_margin;
  std::vector<PairContacts<S>> pairs;
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    const WorldPair<S>& pair = world.pairs[i];
    pairs.push_back(
        {pair.a, pair.b, &contacts[i], pair.friction, pair.restitution,
         round_radius(at(shapes, pair.a)), round_radius(at(shapes, pair.b)),
         head_on_margin<S>(settings, pair.continuous == ImpactMethod::Speculative, margin)});
  }
  const bool looks = std::ranges::any_of(
      world.pairs, [](const auto& pair) { return pair.continuous.has_value(); });
  const std::vector<Body<S>> before = looks ? world.bodies : std::vector<Body<S>>{};
  solve_step<S>(world.bodies, pairs, world.impulses, world.gravity, settings, dt);
  if (!looks) return {};
  if (world.cores.empty()) world.cores = impact_cores(world.bodies, shapes, settings);
  const auto pair_of = [&](int a, int b) -> std::optional<ContinuousPair<S>> {
    for (const WorldPair<S>& pair : world.pairs)
      if (pair.continuous && std::minmax(pair.a, pair.b) == std::minmax(a, b))
        return ContinuousPair<S>{*pair.continuous, pair.friction, pair.restitution};
    return std::nullopt;
  };
  return stop_at_impacts<S>(world.bodies, before, shapes, world.cores, pair_of, settings, dt);
}

}  // namespace contactscope
