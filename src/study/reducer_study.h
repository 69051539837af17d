#pragma once

#include <vector>

#include "study/study.h"

namespace contactscope {

/// Every registered reducer but "none", on 5, 6, 8, 12, 16 and 32 points of elliptical polygons
/// (elliptical_polygon.h) in float, four points kept. Three results from the same runs:
///
/// A reducer that goes by the frame before (coherent) has two lines: one that has seen eight frames
/// before, each a hundredth of the patch away from the next (neighbouring_frame()), and "..., first
/// frame", where it is given no ids.
///
/// "area": 1 - area / area of the best four points, in [0, 1]. The best is the longest chain of
/// corners of the hull, by dynamic programming in double (best_convex_area()), exact but for
/// rounding. What float takes for the larger of two can be smaller by its own rounding, some 1e-7
/// of the area. "wrench": the largest shortfall of the resisted moment (reduction_quality.h), in
/// [0, 2]. "deepest": the share of the polygons whose deepest point was lost, in [0, 1]; it has no
/// worst. A call has failed when it kept no area at all; its errors count, as the largest there
/// are.
///
/// Steps: make the cases from the seed, the same for every method; judge one reduction of each;
/// then time passes over all cases, methods in turn within a repetition and each repetition
/// beginning with another one, so that a slow moment of the machine falls on all alike.
std::vector<trace::Study> study_reducers(const StudyOptions& options,
                                         const StudyProgress& progress);

}  // namespace contactscope
