#pragma once

#include <algorithm>

#include "core/static_vector.h"
#include "reduce/optimal_patch.h"

namespace contactscope {

/// Corners of a patch, counter-clockwise in its coordinates, each below count().
template <class S>
struct CornerRing {
  S doubled_area = S(0);
  StaticVector<int, kMaxManifoldPoints> corners;
};

/// Doubled area of the largest quadrilateral, exact but for rounding. The patch has at least four corners.
template <class S>
S area_of_best_quadrilateral(const Patch<S>& patch);

/// The largest of those that contain corner `through`; of equals the first going round from there.
template <class S>
CornerRing<S> best_quadrilateral_through(const Patch<S>& patch, int through);

/// The two corners farthest apart. One if they coincide.
template <class S>
CornerRing<S> farthest_pair(const Patch<S>& patch);

/// The ring of at most `most` >= 2 corners of a patch that keeps the most: the largest one, or the
/// two extremes when most is 2 or the patch is flat, or one corner when all coincide. Of equally large
/// ones that with the first corner by the id of its point, and then the first going round from there.
template <class S>
CornerRing<S> largest_ring(const Candidates<S>& points, const Patch<S>& patch, int most);

/// The points of a ring, counter-clockwise seen against the normal, beginning with the deepest: the
/// earliest of those whose separations differ by no more than `depth_tie`, metres.
template <class S>
KeptIndices points_of(const Patch<S>& patch, const CornerRing<S>& ring, S depth_tie);

/// Doubled area of the convex hull of a choice, or squared distance of its extremes.
template <class S>
S measure(const Candidates<S>& points, const KeptIndices& kept, bool by_length);

/// What was kept in the frame before, in its order, where all of it is there, one of it has a separation
/// of no more than `deep`, metres, and it is as large as `kept` but for rounding: else `kept`.
template <class S>
KeptIndices as_before_if_equal(const Candidates<S>& points, const Patch<S>& patch,
                               const KeptIndices& kept, S deep, const ReduceOptions& options);

/// A choice of points that contains one given point.
template <class S>
struct ChoiceWith {
  S doubled_area;   // of the hull of all kept; 0 where that is a line or a point
  bool is_in_ring;  // else the given point is no corner of the hull but kept beside them
};

/// The choice of at most `most` >= 1 points that contains `point` and keeps the most, into `kept`,
/// which is empty: `point` first. When another point at the same place is a corner of the patch,
/// `point` takes its part. `depth_tie` as of points_of().
template <class S>
ChoiceWith<S> largest_with(const Candidates<S>& points, Patch<S>& patch, int point, int most,
                           S depth_tie, KeptIndices& kept);

/// The doubled area of the triangle that `centre` makes with the edge from corner i to j. Nothing
/// where it sees the edge from behind: then it is outside of the ring there, and its hull with the
/// ring has no such edge.
template <class S>
S seen(const Patch<S>& patch, const Vec2<S>& centre, int i, int j) {
  return std::max(S(0), cross(patch.corner(i) - centre, patch.corner(j) - centre));
}

}  // namespace contactscope
