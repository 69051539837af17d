#pragma once

#include <optional>
#include <vector>

#include "draw/scene/pairs.h"
#include "trace/find.h"
#include "trace/trace.h"

/// Counts and ranks of contacts. Titles, panels and marks take them from here, so that they cannot
/// contradict each other.
namespace contactscope::draw {

/// Separation of a pair, metres, negative for an overlap; nothing if it is unknown.
std::optional<double> separation_of(const trace::Pair& pair);

/// The deepest point of a pair, with its manifold; nothing without points.
std::optional<PairPoint> deepest_contact(const trace::Pair& pair);

/// Radius of the smaller body, metres; infinite if both are unknown.
double smaller_radius(const trace::Pair& pair, const ShapeMeshes& meshes);

/// Totals of a frame.
struct ContactCounts {
  std::size_t pairs = 0, manifolds = 0, points = 0;  // those with contact points
};
ContactCounts count_contacts(const trace::Frame& frame);

/// Whether a frame has so many contacts that marks at each would hide the bodies.
bool is_heap(const trace::Frame& frame);

/// Quantities by which pairs are ranked.
enum class Rank {
  Overlap,  // metres
  Worst,    // overlap as a share of the smaller body's radius
  Impulse,  // newton seconds
  Change,   // metres between the overlaps of this frame and the previous one
};

struct RankedPair {
  const trace::Pair* pair = nullptr;
  double value = 0;  // > 0
};

/// The first `most` pairs by a quantity, largest first. `before`: the previous frame, for Change.
std::vector<RankedPair> ranked_pairs(const trace::Frame& frame, Rank by, std::size_t most,
                                     const ShapeMeshes& meshes,
                                     const trace::Frame* before = nullptr);

}  // namespace contactscope::draw
