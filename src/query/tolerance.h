#pragma once

#include "core/manifold.h"

/// Tolerances of the separating axis test and of the code based on it. All are relative: those for
/// rounding to the coordinates of the pair, those for preferences to the hulls' size or the depth.
/// A test repeats one contact from 0.1 mm to 10 km.
namespace contactscope {

/// Separations closer than this are a tie broken by rounding. A distance is a sum of four products
/// of unit vectors and coordinates up to `scale`, after a rotation: eight roundings of half an ulp.
template <class S> S tie_tolerance(S scale) {
  return S(4) * std::numeric_limits<S>::epsilon() * scale;
}

/// A point within this distance of a side plane is on it: twice the tie, as both have been rounded.
template <class S> S clip_thickness(S scale) {
  return S(8) * std::numeric_limits<S>::epsilon() * scale;
}

/// Maximum difference between a manifold's deepest point and its axis before clipping counts as
/// failed: the rounding of a few chained intersections.
template <class S> S depth_rounding(S scale) {
  return S(32) * std::numeric_limits<S>::epsilon() * scale;
}

/// Maximum amount by which a preferred axis may be deeper than the best axis; `best` is the largest
/// separation. 5% of the depth keep features from alternating while a body rests (Catto 2007,
/// "Feature Flip-Flop"). For touching shapes that would vanish and rounding would decide, so it is
/// at least 0.2% of the smaller hull's radius, well below the usual slop of a solver.
template <class S> S preference_tolerance(S best, S min_radius) {
  return std::max(S(0.05) * std::abs(best), S(0.002) * min_radius);
}

/// Amount by which an edge pair must beat the faces, so that rounding does not choose it: edges
/// around parallel faces give the same axis again, but only one point, on neither shape. The cross
/// product of edges at kNoisySine is off by about ten roundings over a length of `scale`, and the
/// faces by two more. A preference for faces exceeds this, so it needs no handicap.
template <class S> S edge_handicap(S scale, Preference preference) {
  return preference == Preference::None ? S(12) * std::numeric_limits<S>::epsilon() * scale : S(0);
}

/// Edge pairs with a smaller sine of their angle are skipped. Their face of the Minkowski
/// difference is a sliver; skipping it changes the depth by at most 16 roundings.
template <class S> constexpr S kParallelSine = S(16) * std::numeric_limits<S>::epsilon();

/// Below this sine the direction of a cross product of edges is uncertain by more than ten
/// roundings, which count far along the edges. Support points measure such an axis again.
template <class S> constexpr S kNoisySine = S(0.1);

}  // namespace contactscope
