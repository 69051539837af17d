#pragma once

#include <string>
#include <vector>

#include "lint/claims.h"
#include "versus/rollout.h"

namespace contactscope::versus {

/// A body that passed through another shape between two frames.
struct Passing {
  std::string body, other;
};

/// Finds the passings in the step between two frames from shapes and poses alone. Bodies that move
/// by more than their thickness are sampled between the frames, with linear positions and constant
/// rotation. A body has passed if it is inside another by a quarter of the thinner one's thickness
/// in between, but in neither frame. Both frames must have the poses of all shapes.
std::vector<Passing> passings(const lint::Solids& solids, const std::vector<RolloutBody>& bodies,
                              const trace::Frame& before, const trace::Frame& now);

}  // namespace contactscope::versus
