#pragma once

#include "core/pose.h"
#include "geometry/hull.h"

namespace contactscope {

/// The separation of two hulls, metres, negative in overlap: the largest over all faces of their
/// Minkowski difference. Meant for hulls that overlap; of separated ones it is a lower bound of the
/// distance. In extended precision and with nothing shared with the queries that it judges.
///
/// Source: Gregorius, "The Separating Axis Test between Convex Polyhedra", GDC 2013. Steps: each
/// face plane of either hull against every vertex of the other; each pair of edges whose arcs cross
/// on the Gauss map by the talk's IsMinkowskiFace, its distance by the talk's Project. Face normals
/// are made anew from the vertices.
double oracle_separation(const Hull<double>& a, const Hull<double>& b, const Pose<double>& b_in_a);

}  // namespace contactscope
