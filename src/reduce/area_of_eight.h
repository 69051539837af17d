#pragma once

#include "reduce/steps.h"

namespace contactscope {

/// What `area` keeps of five to eight points where four are to be kept and nobody watches: the same
/// points in the same order, with every score measured for all points at a time. Most manifolds have
/// no more points: two boxes that touch with faces have eight at most.
///
/// False, and nothing kept, where all points are on a line, and where squares of lengths leave the range of S; then the
/// reducer goes point by point.
template <class S>
bool area_of_eight(const Candidates<S>& points, KeptIndices& kept);

}  // namespace contactscope
