#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/manifold.h"

/// The tolerances of the separating axis test and of what is built on it. Every one is relative: to
/// the coordinates of the pair where it stands for rounding, to the hulls' size or the depth where
/// it stands for a preference. A test repeats one contact from 0.1 mm to 10 km.
namespace contactscope {

/// Separations closer than this are a geometric tie that rounding broke. A distance is a sum of
/// four products of unit vectors and coordinates up to `scale`, after a rotation of as many: some
/// eight roundings of half an ulp each.
template <class S>
S tie_tolerance(S scale) {
  return S(4) * std::numeric_limits<S>::epsilon() * scale;
}

/// A point this near to a side plane is on it. Twice the tie tolerance, because both the point and
/// the plane have been rounded.
template <class S>
S clip_thickness(S scale) {
  return S(8) * std::numeric_limits<S>::epsilon() * scale;
}

/// How far a manifold's deepest point may fall short of the axis that made it before that counts as
/// a failure of the clipping: the rounding of a few chained intersections.
template <class S>
S depth_rounding(S scale) {
  return S(32) * std::numeric_limits<S>::epsilon() * scale;
}

/// How much deeper than the best axis a preferred one may be; `best` is the largest separation.
/// 5% of the depth keeps features from alternating while a body rests (Catto 2007, "Feature
/// Flip-Flop"). At a kiss that would vanish and rounding would choose, so it is at least 0.2% of
/// the smaller hull's radius, which is well under what a solver leaves as slop.
template <class S>
S preference_tolerance(S best, S min_radius) {
  return std::max(S(0.05) * std::abs(best), S(0.002) * min_radius);
}

/// By how much an edge pair has to beat the faces, as rounding may not choose it: where faces lie in
/// parallel planes the edges around them give the same axis once more, but one point, and not on either
/// shape. The cross product of edges at kNoisySine is off by some ten roundings over a length of `scale`, and
/// the faces by two more. A preference for faces is wider, and leaves nothing to do.
template <class S>
S edge_handicap(S scale, Preference preference) {
  return preference == Preference::None ? S(12) * std::numeric_limits<S>::epsilon() * scale : S(0);
}

/// Edges whose sine of the angle between them is less than this give no axis of their own. The
/// face that they make on the Minkowski difference is a sliver as wide as edge length times sine,
/// so leaving it out moves the depth by at most that: 16 roundings.
template <class S>
constexpr S kParallelSine = S(16) * std::numeric_limits<S>::epsilon();

/// Below this sine the direction of the cross product of two edges is uncertain by more than ten
/// roundings, and so would be a distance measured between points far along the edges; such an axis
/// is measured again with true support points before it wins.
template <class S>
constexpr S kNoisySine = S(0.1);

}  // namespace contactscope
