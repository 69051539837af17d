#pragma once

#include <span>
#include <vector>

#include "dynamics/prepare.h"

namespace contactscope {

/// With lengths that were not given by the smallest dynamic body, see solver_settings.h.
template <class S>
SolverSettings settled(const SolverSettings& settings, const std::vector<Body<S>>& bodies) {
  if (settings.slop && settings.speculative_margin) return settings;
  return settled(settings, smallest_size(bodies));
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
