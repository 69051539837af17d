#pragma once

#include "reduce/steps.h"

namespace contactscope {

/// The result of `area` for five to eight points, keeping four, without a record: the same
/// points in the same order, with each score measured for all points at once. Most manifolds have
/// no more points: two boxes with face contact have at most eight.
///
/// Returns false and keeps nothing if all points are on a line, or if squared lengths leave the
/// range of S. The reducer then proceeds point by point.
template <class S> bool area_of_eight(const Candidates<S>& points, KeptIndices& kept);

}  // namespace contactscope
