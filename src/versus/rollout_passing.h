#pragma once

#include <string>
#include <vector>

#include "lint/claims.h"
#include "versus/rollout.h"

namespace contactscope::versus {

/// A body that was on one side of another shape in a frame and on the other side in the next.
struct Passing {
  std::string body, other;
};

/// Those of the step from one frame to the next, by shapes and poses alone: bodies that move by more than their own
/// thickness are looked at between the frames too, on straight ways and with even turns. Who is in another by a
/// quarter of the thinner one's thickness on the way, and in neither frame, has passed. Both frames have the
/// poses of all shapes.
std::vector<Passing> passings(const lint::Solids& solids, const std::vector<RolloutBody>& bodies,
                              const trace::Frame& before, const trace::Frame& now);

}  // namespace contactscope::versus
