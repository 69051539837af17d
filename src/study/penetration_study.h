#pragma once

#include <vector>

#include "study/study.h"

namespace contactscope {

/// Depth and normal of the penetration methods, in float and in double, over what each is given: EPA
/// and MPR over their tolerance, a fraction of the pair's length scale from none to a tenth, and over
/// the cap on their iterations; sampling over the number of directions, with the search about the
/// best and with one round of it; the separating axis test as one point.
///
/// Cases are those of `study hull_precision` with 32 vertices, every other one pushed together until
/// centroids are half as far apart or less. Two measures, both against extended precision over all
/// axes: the depth's error over the size of the hulls, and the angle between the normals in radians
/// (where two axes are nearly as deep, a small error of the depth is a large one of the normal). The
/// parameter of a point is what the method was given: tolerance, iterations, directions.
///
/// A call has failed when it finds no depth, or one that falls short of the true one by more than
/// rounding, so that moving by it would not part the hulls. To end at the cap on iterations is no
/// failure here: that is what is studied.
std::vector<trace::Study> study_penetration(const StudyOptions& options,
                                            const StudyProgress& progress);

}  // namespace contactscope
