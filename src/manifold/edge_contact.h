#pragma once

#include "query/placed_features.h"
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

/// The same of half-edges of two hulls of which nothing else is placed.
template <class S>
ClosestPoints<S> closest_points(const PlacedFeatures<S, false>& a, int edge_a,
                                const PlacedFeatures<S, true>& b, int edge_b);

/// Gregorius 2015, "Hull vs Hull: Edge Contact": one point in the middle of the closest points of
/// the two edges, separation from the separating axis test, id the two edges. Position in A's
/// frame.
template <class S>
ContactPoint<S> create_edge_contact(const HullPair<S>& pair, const EdgeQuery<S>& query);

/// The same from closest points that are known.
template <class S>
ContactPoint<S> create_edge_contact(const ClosestPoints<S>& closest, const EdgeQuery<S>& query);

}  // namespace contactscope
