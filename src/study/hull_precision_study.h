#pragma once

#include <random>
#include <vector>

#include "core/pose.h"
#include "geometry/hull.h"
#include "study/study.h"

namespace contactscope {

struct OverlappingHulls {
  Hull<double> a, b;
  Pose<double> b_in_a;
  double size = 1;             // metres: the longest semi-axis of both
  double separation = 0;       // metres, < 0: the oracle's (depth_oracle.h)
  Vec3d way = Vec3d::UnitX();  // unit, A's frame: from where B came, for methods that look back
  Vec3d turn_axis = Vec3d::UnitX();  // unit, A's frame: about which it turned
};

/// Two hulls of `vertices` points each on ellipsoids with semi-axes of 0.5 to 1 times a size of 1
/// mm to 1 km (log-uniform), turned at random, moved along a random direction until they overlap by
/// 1 to 10% of the size along it; drawn again where another axis separates them.
OverlappingHulls overlapping_hulls(std::mt19937_64& engine, int vertices);

/// The depth that the separating axis test finds, in float and in double, for hulls of 8, 16, 32
/// and 64 vertices: walking the Gauss map as sat() does, asking every pair of edges whether it
/// makes a Minkowski face, and measuring every pair by support points. Beside them whole contacts
/// by collide_hull_hull(): of the deepest axis, without the preference for coherent features; and
/// with it, anew and with the cache that the pair's motion up to its pose has left (only coherent
/// features are cached).
///
/// The error is |separation - oracle| over the size of the hulls. Coherent contacts may prefer an
/// axis that is a little deeper, which is no error: of them the oracle measures the axis that they
/// took (separation_along()). For float the error includes what rounding the input to float costs.
/// A call has failed when it finds no overlap.
std::vector<trace::Study> study_hull_precision(const StudyOptions& options,
                                               const StudyProgress& progress);

}  // namespace contactscope
