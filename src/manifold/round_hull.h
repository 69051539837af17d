#pragma once

#include <limits>

#include "core/pose.h"
#include "geometry/hull.h"

/// What spheres and capsules against hulls share. They are worked on in the hull's own frame: there
/// the hull's lanes stand ready, and its vertices are as exact as they were given.
namespace contactscope {

/// A core nearer to a vertex or an edge than this touches it: the difference of the closest points
/// is an ulp of the coordinates or so in each component, and would turn the normal by a quarter.
template <class S>
S touching_distance(S scale) {
  return S(16) * std::numeric_limits<S>::epsilon() * scale;
}

/// Directions whose angle has less than this sine are nearly parallel. Separations along both differ
/// by 0.1% then, a fiftieth of what a preference between axes accepts.
template <class S>
constexpr S kNearlyParallelSine = S(0.05);

/// No coordinate is larger than this, in either frame, nor was on the way from one to the other.
/// `core_reach` is that of the round shape in its own frame.
template <class S>
S length_scale(const Hull<S>& hull, const Pose<S>& b_in_a, S core_reach) {
  return hull.centroid.norm() + hull.radius + b_in_a.position.norm() + core_reach;
}

}  // namespace contactscope
