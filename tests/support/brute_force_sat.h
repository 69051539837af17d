#pragma once

#include <vector>

#include "core/pose.h"
#include "geometry/hull.h"

namespace contactscope::test {

/// The separating axis test by its definition, in double: every face normal of both hulls and the
/// cross product of every pair of edges. Each axis is measured by projecting all vertices of both
/// hulls. World frame, metres. Uses vertices and topology of the hulls, not their planes.
struct BruteForceAxis {
  double separation;  // the largest along any axis; negative in overlap
  Vec3d normal;       // unit, from A to B
};

BruteForceAxis brute_force_sat(const Hull<double>& a, const Pose<double>& pose_a,
                               const Hull<double>& b, const Pose<double>& pose_b);

/// The same from points alone: normals of three points of one hull, and cross products of
/// differences. Axes that belong to no face or edge only measure less. Differences are taken in the
/// hulls' own frames, where near points keep their digits. `b` is placed by `b_in_a`; the normal is
/// in A's frame. For few points only: the time grows with the fourth power.
BruteForceAxis brute_force_sat(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b,
                               const Pose<double>& b_in_a);

/// Separation of both hulls' projections on a unit direction from A to B, world; negative: overlap.
double separation_along(const Vec3d& direction, const Hull<double>& a, const Pose<double>& pose_a,
                        const Hull<double>& b, const Pose<double>& pose_b);

}  // namespace contactscope::test
