#pragma once

#include <algorithm>
#include <vector>

#include "dynamics/solver.h"
#include "manifold/pair_cache.h"

namespace contactscope {

/// Two bodies that may touch, and what is kept of them from step to step.
template <class S>
struct WorldPair {
  int a = 0, b = 0;
  CollideOptions options;  // `reduction.previous` is set from `kept`
  S friction = S(0.6);
  S restitution = 0;
  bool cached = true;             // temporal coherence, see pair_cache.h
  PairCache<S> cache{};           // from here on what is kept
  std::vector<FeatureId> kept{};  // ids, for reducers that remember
};

/// Everything that moves. A value: a copy is a snapshot, and goes on as the original would have.
template <class S>
struct World {
  Vec3<S> gravity = Vec3<S>(S(0), S(-9.81), S(0));  // metres a second, a second
  std::vector<Body<S>> bodies;
  std::vector<WorldPair<S>> pairs;
  std::vector<PairImpulses<S>> impulses;  // of the last step, one a pair
};

/// Contacts where the bodies are now, one entry a pair; `shapes` has one a body. Points up to the
/// larger of the pair's margin and the speculative margin, settled(), are kept.
template <class S>
void find_contacts(World<S>& world, const std::vector<Shape<S>>& shapes,
                   const SolverSettings& settings, std::vector<Manifolds<S>>& contacts) {
  contacts.resize(world.pairs.size());
  const double speculative = *settled(settings, world.bodies).speculative_margin;
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    WorldPair<S>& pair = world.pairs[i];
    const auto a = static_cast<std::size_t>(pair.a);
    const auto b = static_cast<std::size_t>(pair.b);
    CollideOptions options = pair.options;
    options.margin = static_cast<S>(std::max(options.margin, speculative));
    options.reduction.previous = pair.kept;
    collide(shapes[a], world.bodies[a].pose(), shapes[b], world.bodies[b].pose(), options,
            contacts[i], pair.cached ? &pair.cache : nullptr);
    pair.kept.clear();
    for (const Manifold<S>& manifold : contacts[i])
      for (const ContactPoint<S>& point : manifold.points) pair.kept.push_back(point.id);
  }
}

/// find_contacts, then solve_step: `dt` seconds. The contacts stay to be looked at.
template <class S>
void step(World<S>& world, const std::vector<Shape<S>>& shapes, const SolverSettings& settings,
          S dt, std::vector<Manifolds<S>>& contacts) {
  find_contacts(world, shapes, settings, contacts);
  std::vector<PairContacts<S>> pairs;
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    const WorldPair<S>& pair = world.pairs[i];
    pairs.push_back({pair.a, pair.b, &contacts[i], pair.friction, pair.restitution});
  }
  solve_step<S>(world.bodies, pairs, world.impulses, world.gravity, settings, dt);
}

}  // namespace contactscope
