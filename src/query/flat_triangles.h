#pragma once

#include "query/triangle_overlap.h"

namespace contactscope {

/// The rare cases of triangle_overlap, equally exact: one triangle lies in the plane of the other,
/// or has no area. Steps:
///   1. both have an area: project along the axis of largest area. No edge has the whole other
///      triangle on its outer side or on itself: Coplanar. An edge has it strictly on its outer
///      side: None. Otherwise Touching, at corners of the two;
///   2. else: collect corners inside the other triangle, crossings of edges, and edges that pierce
///      the other. The two points with the largest distance are the ends.
/// `segment` is only set if `wants_segment`.
TriangleOverlap<double> flat_triangle_overlap(const Triangle<double>& a, const Triangle<double>& b,
                                              bool wants_segment);

/// Intersection of the edge from p to q with a plane or line. `of_p` and `of_q` are the signed
/// distances of p and q in any unit, not both zero and without a common sign. The result is on the
/// edge, and the same if the ends are swapped.
Vec3d crossing_point(const Vec3d& p, double of_p, const Vec3d& q, double of_q);

}  // namespace contactscope
