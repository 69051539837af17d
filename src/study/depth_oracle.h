#pragma once

#include "core/pose.h"
#include "geometry/hull.h"

namespace contactscope {

/// An axis and the separation along it, metres, negative in overlap.
struct OracleAxis {
  double separation;
  Vec3d normal;  // unit, from A to B, in A's frame
};

/// The separation of two hulls, metres, negative in overlap: the largest over all faces of their
/// Minkowski difference. Meant for hulls that overlap; of separated ones it is a lower bound of the
/// distance. In extended precision and with nothing shared with the queries that it judges.
///
/// Source: Gregorius, "The Separating Axis Test between Convex Polyhedra", GDC 2013. Steps: each
/// face plane of either hull against every vertex of the other; each pair of edges whose arcs cross
/// on the Gauss map by the talk's IsMinkowskiFace, its distance by the talk's Project. Face normals
/// are made anew from the vertices.
OracleAxis oracle_axis(const Hull<double>& a, const Hull<double>& b, const Pose<double>& b_in_a);

/// That of oracle_axis().
double oracle_separation(const Hull<double>& a, const Hull<double>& b, const Pose<double>& b_in_a);

/// The separation along one axis, metres, in extended precision: from what A reaches farthest along
/// `normal` (from A to B, in A's frame; made unit here) to what B reaches least.
double separation_along(const Hull<double>& a, const Hull<double>& b, const Pose<double>& b_in_a,
                        const Vec3d& normal);

}  // namespace contactscope
