#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// Of the reference area, a choice may lose this much before another is made.
inline constexpr double kCoherentTolerance = 0.05;
/// How much shallower than the deepest point the deepest kept one may be, of the square root of the
/// largest area (of the length of points on a line), or if that is more, of the deepest
/// separation. As the preference between the axes of the separating axis test.
inline constexpr double kCoherentDepthOfLength = 0.002;
inline constexpr double kCoherentDepthOfSeparation = 0.05;

/// A reducer that keeps the points of the frame before, by their ids, while they are good enough:
/// an id that changes costs the solver its impulse. Two things are bounded in every frame, whatever
/// went before:
/// - Depth: one of the kept is no more than a slack (the constants above) shallower than the
///   deepest.
/// - Area: the hull of the kept, seen along the normal, is no less than 95% of the reference. That
///   is the largest area of at most max_points points with one among them that is within half of
///   the slack: as reduce_to_optimal has wherever the patch is nearly level or its best points
///   include a deep one, else never less than 1 - 2 / max_points of it (without the corner that
///   costs least there is room for a deep point), and never less than reduce_to_optimal_deepest. So
///   of reduce_to_optimal never less than 0.95 (1 - 2 / max_points): 47.5% for four points.
/// For one or two points, and for points on one line, the distance of the extremes takes the place
/// of area.
///
/// Depth comes first, because a corner that sinks while no point is there to hold it is worse than
/// one that is held with a shorter lever.
///
/// Hysteresis: what was kept stays, in its order, while all of its ids are there and it fulfils
/// both. A new choice must fulfil both by half of the tolerance and half of the slack, so noise
/// that moves neither by that much changes nothing. Of such choices of corners of the patch the one
/// with the most kept ids is made, and of those the one of largest area: first the old points in
/// their order, then the new ones round the patch. With more than eight points, or on a line, or
/// when no id is there again, it is the reference itself, in the order of the optimal reducers.
///
/// Equal ids are told apart by their order among the points.
template <class S>
KeptIndices reduce_coherently(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                              const ReduceOptions& options);

}  // namespace contactscope
