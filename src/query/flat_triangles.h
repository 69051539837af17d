#pragma once

#include "query/triangle_overlap.h"

namespace contactscope {

/// Two triangles of which one lies in the plane of the other or has no area; the rare part of
/// triangle_overlap, exact like it. Steps:
///   1. both have an area: the projection along the axis that shows it largest. No edge has all of
///      the other triangle on its far side or on itself: Coplanar. One has it strictly on its far
///      side: None. Otherwise Touching, in corners of the two;
///   2. else: corners of each that are in the other, edges that cross, edges that pierce the other.
///      The two that are farthest apart are the ends.
/// `segment` is made only when asked for.
TriangleOverlap<double> flat_triangle_overlap(const Triangle<double>& a, const Triangle<double>& b,
                                              bool wants_segment);

/// Where the edge from p to q meets a plane or line of which p has the signed distance `of_p` and q
/// `of_q`, in any unit, not both zero and of no common sign. On the edge, and the same with the ends
/// exchanged.
Vec3d crossing_point(const Vec3d& p, double of_p, const Vec3d& q, double of_q);

}  // namespace contactscope
