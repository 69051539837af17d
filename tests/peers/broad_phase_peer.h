#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "geometry/aabb.h"

namespace contactscope::peers {

/// The broad phase of another library.
class BroadPhasePeer {
 public:
  virtual ~BroadPhasePeer() = default;
  virtual const char* name() const = 0;
  /// Moves box i to boxes[i]; the first call adds them. As many at each call.
  virtual void place(std::span<const Aabb<float>> boxes) = 0;
  /// Pairs that the library reports, each once, in any order. Some report boxes that only nearly
  /// touch.
  virtual std::vector<std::pair<int, int>> pairs() = 0;
};

/// One of each that these libraries have, made anew.
std::vector<std::unique_ptr<BroadPhasePeer>> bullet_broad_phases();
std::vector<std::unique_ptr<BroadPhasePeer>> fcl_broad_phases();
std::vector<std::unique_ptr<BroadPhasePeer>> ode_broad_phases();
std::vector<std::unique_ptr<BroadPhasePeer>> broad_phase_peers();

}  // namespace contactscope::peers
