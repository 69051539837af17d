#include "dynamics/world.h"

#include <algorithm>

namespace contactscope {

template <class S>
void find_contacts(World<S>& world, const std::vector<Shape<S>>& shapes,
                   const SolverSettings& settings, std::vector<Manifolds<S>>& contacts) {
  contacts.resize(world.pairs.size());
  const double speculative = *settled(settings, world.bodies).speculative_margin;
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    WorldPair<S>& pair = world.pairs[i];
    const auto a = static_cast<std::size_t>(pair.a);
    const auto b = static_cast<std::size_t>(pair.b);
    CollideOptions<S> options = pair.options;
    options.margin = std::max(options.margin, static_cast<S>(speculative));
    options.reduction.previous = pair.kept;
    collide(shapes[a], world.bodies[a].pose(), shapes[b], world.bodies[b].pose(), options,
            contacts[i], pair.cached ? &pair.cache : nullptr);
    pair.kept.clear();
    for (const Manifold<S>& manifold : contacts[i])
      for (const ContactPoint<S>& point : manifold.points) pair.kept.push_back(point.id);
  }
}

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

#define CONTACTSCOPE_INSTANTIATE(S)                                                           \
  template void find_contacts(World<S>&, const std::vector<Shape<S>>&, const SolverSettings&, \
                              std::vector<Manifolds<S>>&);                                    \
  template void step(World<S>&, const std::vector<Shape<S>>&, const SolverSettings&, S,       \
                     std::vector<Manifolds<S>>&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
