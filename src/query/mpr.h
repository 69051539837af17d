#pragma once

#include "query/penetration.h"

namespace contactscope {

/// Cap on the steps of MPR, those of finding the first portal included.
inline constexpr int kMaxMprIterations = 256;

/// Minkowski portal refinement (see mpr.cpp and penetration.h).
///
/// **What it is known for**: the normal is that of the face through which the ray from the middle of
/// the difference through the origin leaves it. That is the face of least depth only where the ray
/// happens to meet it: for a plate that lies off centre on another, the ray may leave through a
/// side. The depth is true along that normal, so it is never less than the least depth but can be
/// many times as large; `study penetration` measures how much. No bound from below is known.
template <class S>
PenetrationResult<S> mpr(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                         const PenetrationOptions<S>& options, PenetrationSteps<S>* steps);

}  // namespace contactscope
