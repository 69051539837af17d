#pragma once

#include "query/hull_pair.h"

namespace contactscope {

/// The two ways of the separating axis test that the Gauss map saves us from walking (gauss_map.h),
/// to measure what it saves. Both give the largest separation over all axes, metres, negative in
/// overlap; face queries are those of sat(). Source: Gregorius 2013 and 2015.

/// Every cross product of two edges is an axis, measured by the support points of both hulls.
template <class S>
S separation_by_all_edge_pairs(const HullPair<S>& pair);

/// Every pair of edges is asked whether it makes a face of the Minkowski difference (the talk's
/// IsMinkowskiFace), and only those that do are measured, by a point of each edge.
template <class S>
S separation_by_minkowski_faces(const HullPair<S>& pair);

}  // namespace contactscope
