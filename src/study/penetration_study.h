#pragma once

#include <vector>

#include "study/study.h"

namespace contactscope {

/// Depth and normal of the penetration methods, in float and in double, over six efforts, the
/// parameter: EPA and MPR by their tolerance, 0.1 of the pair's length scale, 0.01, ... 1e-5, and what
/// rounding allows, or by the cap on their iterations, 2, 4, ... 64; sampling by the number of
/// directions, 8, 32, ... 8192, with the search about the best until it converges and with one round
/// of it. The separating axis test is the same at every effort.
///
/// Cases are those of `study hull_precision` with 32 vertices, every other one pushed together until
/// centroids are half as far apart or less. Two measures against extended precision over all axes:
/// the depth's error over the size of the hulls, and the angle between the normals in radians (where
/// two axes are nearly as deep, a small error of the depth is a large one of the normal). A third,
/// "unfinished", is the share of the pairs on which the status was not Converged.
///
/// The worst error of sampling need not fall with the number of directions: the search about the best
/// one is local, so the worst pair is one whose best direction lies beside a wrong facet, and another
/// number of directions finds another one. Without that search ("one round") it falls throughout.
///
/// A call has failed when it finds no depth, or one that falls short of the true one by more than
/// rounding, so that moving by it would not part the hulls. To end at the cap on iterations is no
/// failure here: that is what is studied.
std::vector<trace::Study> study_penetration(const StudyOptions& options,
                                            const StudyProgress& progress);

}  // namespace contactscope
