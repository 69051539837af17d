#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "dynamics/body.h"
#include "dynamics/solver_settings.h"
#include "manifold/dispatch.h"

namespace contactscope {

/// What the contact pipeline found of one pair of bodies.
template <class S>
struct PairContacts {
  int a = 0, b = 0;                         // bodies; normals point from a to b
  const Manifolds<S>* manifolds = nullptr;  // nullptr: none
  S friction = 0;                           // Coulomb's coefficient of the pair
  S restitution = 0;                        // of the pair
};

/// What the last step gave one point. Impulses on b, newton seconds, world.
template <class S>
struct PointImpulse {
  int triangle = -1;  // of a mesh; ids count within it
  FeatureId id;
  S normal = 0;  // of the last sub-step: where the next one begins
  Vec3<S> friction = Vec3<S>::Zero();
  S total_normal = 0;  // over the whole step
  Vec3<S> total_friction = Vec3<S>::Zero();
  S warm_start = 0;  // share of total_normal that it began with
};

/// Of one pair, in the order of its manifolds and their points.
template <class S>
using PairImpulses = std::vector<PointImpulse<S>>;

/// With lengths that were not given by the least shortest_edge() of all dynamic bodies, 0 where there
/// is none; see solver_settings.h.
template <class S>
SolverSettings settled(const SolverSettings& settings, const std::vector<Body<S>>& bodies) {
  if (settings.slop && settings.speculative_margin) return settings;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Body<S>& body : bodies) {
    if (!body.dynamic()) continue;
    const Mat3<double> inertia = body.inertia.template cast<double>();
    smallest = std::min(smallest, shortest_edge(static_cast<double>(body.mass), inertia));
  }
  return settled(settings, smallest < std::numeric_limits<double>::infinity() ? smallest : 0);
}

/// Moves `bodies` by `dt` seconds (> 0), so that the contacts hold. `pairs` are what the pipeline
/// found where the bodies are now; `impulses` (one a pair) holds what the points got in the step
/// before and after the call what they got in this one, in the order of manifolds and points.
/// Gravity in metres a second, a second. What `settings` leave open is settled().
///
/// Contacts are found once, at the beginning; between sub-steps their anchors move with the bodies,
/// and the normal stays. Nothing is random and nothing depends on addresses: the same input gives the
/// same bits.
template <class S>
void solve_step(std::vector<Body<S>>& bodies, std::span<const PairContacts<S>> pairs,
                std::vector<PairImpulses<S>>& impulses, const Vec3<S>& gravity,
                const SolverSettings& settings, S dt);

}  // namespace contactscope
