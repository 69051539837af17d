#pragma once

#include <optional>

#include "reduce/optimal_ring.h"

namespace contactscope {

inline constexpr int kMostCoherentCorners = 8;

/// What is asked of a ring of corners.
template <class S>
struct CoherentWish {
  const bool* is_old;   // by corner
  const bool* is_deep;  // by corner
  // A deep point inside of the patch that is kept beside the ring: the hull with it counts. Without
  // one the ring must have a deep corner.
  std::optional<PlanePoint<S>> beside;
  S least_doubled_area;
  int most;  // corners, 2 to kMostCoherentCorners
};

template <class S>
struct CoherentRing {
  int old = 0;
  CornerRing<S> ring;  // empty when no ring has an old corner and all that is asked
};

/// The ring that has the most old corners of those that fulfil the wish, and of equals the largest.
template <class S>
CoherentRing<S> most_coherent_ring(const Patch<S>& patch, const CoherentWish<S>& wish);

}  // namespace contactscope
