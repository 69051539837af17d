#pragma once

#include <vector>

#include "study/study.h"

namespace contactscope {

/// Every registered reducer but "none", on 5, 6, 8, 12, 16 and 32 points of elliptical polygons
/// (elliptical_polygon.h) in float, four points kept. Three results from the same runs:
///
/// "area": 1 - area / area of the best four points, by an exact oracle in double, in [0, 1].
/// "wrench": the largest shortfall of the resisted moment (reduction_quality.h), in [0, 2].
/// "deepest": the share of the polygons whose deepest point was lost, in [0, 1]; it has no worst.
/// A call has failed when its status is not Reduced, when it kept no point, or an area of 0.
///
/// Steps: make the cases from the seed, the same for every method; judge one reduction of each;
/// then time passes over all cases, methods in turn within a repetition and each repetition
/// beginning with another one, so that a slow moment of the machine falls on all alike.
std::vector<trace::Study> study_reducers(const StudyOptions& options,
                                         const StudyProgress& progress);

}  // namespace contactscope
