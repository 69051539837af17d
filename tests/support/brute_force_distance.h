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

/// A point, a segment or a convex polyhedron as its features. A face with three vertices is itself;
/// one with more stands as all triangles between its vertices (up to six vertices, beyond as a
/// fan), and its diagonals stand among the edges: it need not be quite planar.
struct Features {
  std::vector<ExtendedPoint> vertices;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::array<int, 3>> triangles;  // counter-clockwise seen from outside
  /// Of a flat hull, whose two faces alone bound nothing: for each edge a point of it and the
  /// direction in the plane that points away from it.
  std::vector<std::array<ExtendedPoint, 2>> walls{};
};

Features features_of_point(const Vec3d& point, const Pose<double>& pose);
Features features_of_segment(const Vec3d& from, const Vec3d& to, const Pose<double>& pose);
/// One of no area is its edges.
Features features_of_triangle(const std::array<ExtendedPoint, 3>& corners);
Features features_of(const Hull<double>& hull, const Pose<double>& pose);

struct BruteForceDistance {
  Extended distance;         // 0 where they touch or overlap
  ExtendedPoint on_a, on_b;  // a pair of closest points; of no meaning where they overlap
};

BruteForceDistance brute_force_distance(const Features& a, const Features& b);

/// The distance of two segments by nested search: for a point on A the closest point of B is known,
/// and its distance is convex along A. Slow; judges the oracle above and what is only segments.
Extended segment_distance_by_search(const ExtendedPoint& from_a, const ExtendedPoint& to_a,
                                    const ExtendedPoint& from_b, const ExtendedPoint& to_b);

/// The largest distance between two points of `a` and `b` together: what rounding is relative to.
double extent(const Features& a, const Features& b);

}  // namespace contactscope::test
