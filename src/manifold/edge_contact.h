#pragma once

#include "query/sat.h"

namespace contactscope {

/// A's frame, metres.
template <class S>
struct ClosestPoints {
  Vec3<S> on_a;
  Vec3<S> on_b;
};

/// Closest points of the two edges of an edge query that found a pair.
template <class S>
ClosestPoints<S> closest_points(const HullPair<S>& pair, const EdgeQuery<S>& query);

/// Gregorius 2015, "Hull vs Hull: Edge Contact": one point in the middle of the closest points of
/// the two edges, separation from the separating axis test, id the two edges. Position in A's
/// frame.
template <class S>
ContactPoint<S> create_edge_contact(const HullPair<S>& pair, const EdgeQuery<S>& query);

}  // namespace contactscope
