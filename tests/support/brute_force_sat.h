#pragma once

#include "core/pose.h"
#include "geometry/hull.h"

namespace contactscope::test {

/// The separating axis test by its definition, in double: every face normal of both hulls and the
/// cross product of every pair of edges, each measured by projecting all vertices of both hulls on
/// it. World frame, metres. Uses vertices and topology of the hulls, not their planes.
struct BruteForceAxis {
  double separation;  // the largest along any axis; negative in overlap
  Vec3d normal;       // unit, from A to B
};

BruteForceAxis brute_force_sat(const Hull<double>& a, const Pose<double>& pose_a,
                               const Hull<double>& b, const Pose<double>& pose_b);

/// The gap between the projections of both hulls on a unit direction (world frame) that points from
/// A to B; negative in overlap.
double separation_along(const Vec3d& direction, const Hull<double>& a, const Pose<double>& pose_a,
                        const Hull<double>& b, const Pose<double>& pose_b);

}  // namespace contactscope::test
