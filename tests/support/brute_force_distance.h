#pragma once

#include <array>
#include <vector>

#include "core/pose.h"
#include "geometry/hull.h"

/// Distances by exhaustion, in extended precision: every vertex against every face, every edge
/// against every edge. Nothing here iterates over a simplex or looks for a support point.
namespace contactscope::test {

using Extended = long double;
using ExtendedPoint = Eigen::Matrix<Extended, 3, 1>;

/// The features of a point, a segment or a convex polyhedron. A face of more than three vertices
/// need not be quite planar: it becomes all triangles between its vertices (a fan beyond six
/// vertices), and its diagonals are edges too.
struct Features {
  std::vector<ExtendedPoint> vertices;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::array<int, 3>> triangles;  // counter-clockwise seen from outside
  /// Only for flat hulls, which their faces do not bound: a point of each edge and its outward
  /// side.
  std::vector<std::array<ExtendedPoint, 2>> walls{};
};

Features features_of_point(const Vec3d& point, const Pose<double>& pose);
Features features_of_segment(const Vec3d& from, const Vec3d& to, const Pose<double>& pose);
/// A triangle without area has only its edges.
Features features_of_triangle(const std::array<ExtendedPoint, 3>& corners);
Features features_of(const Hull<double>& hull, const Pose<double>& pose);

struct BruteForceDistance {
  Extended distance;         // 0 if they touch or overlap
  ExtendedPoint on_a, on_b;  // a pair of closest points; meaningless if they overlap
};

BruteForceDistance brute_force_distance(const Features& a, const Features& b);

/// Distance of two segments by nested search. The closest point of B is known for a point on A, and
/// its distance is convex along A. Slow: it checks the oracle above, and tests of segments only.
Extended segment_distance_by_search(const ExtendedPoint& from_a, const ExtendedPoint& to_a,
                                    const ExtendedPoint& from_b, const ExtendedPoint& to_b);

/// The largest distance between two points of `a` and `b` together. Rounding is relative to it.
double extent(const Features& a, const Features& b);

}  // namespace contactscope::test
