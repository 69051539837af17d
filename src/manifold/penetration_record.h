#pragma once

#include <optional>

#include "geometry/hull.h"
#include "manifold/to_world.h"
#include "query/penetration.h"
#include "trace/trace.h"

namespace contactscope {

/// What a penetration method found and did, as facts in the world; told for the shapes the other way
/// round where `mirrored`. `result` and `steps` are in A's frame.
template <class S>
trace::Penetration penetration_record(const ToWorld<S>& to_world, bool mirrored,
                                      PenetrationMethod method, const PenetrationResult<S>& result,
                                      const PenetrationSteps<S>& steps);

/// Most differences of two vertices of which the Minkowski difference is made: two hulls of 64
/// vertices. It takes some milliseconds.
inline constexpr int kMaxMinkowskiPoints = 4096;

/// The Minkowski difference B - A in the world's axes, or A - B where `mirrored`: the hull of the
/// differences of all vertices. Empty where these are more than kMaxMinkowskiPoints, and where the
/// builder gives no hull of them.
template <class S>
std::optional<trace::Minkowski> minkowski_record(const ToWorld<S>& to_world, bool mirrored,
                                                 const Hull<S>& a, const Hull<S>& b,
                                                 const Pose<S>& b_in_a);

}  // namespace contactscope
