#pragma once

#include "core/static_vector.h"
#include "reduce/optimal_patch.h"

namespace contactscope {

/// Corners of a patch, counter-clockwise in its coordinates, each below count().
template <class S>
struct CornerRing {
  S doubled_area = S(0);
  StaticVector<int, kMaxManifoldPoints> corners;
};

/// The largest quadrilateral, exact but for rounding. The patch has at least four corners.
template <class S>
CornerRing<S> best_quadrilateral(const Patch<S>& patch);

/// The same, of those that contain corner `through`.
template <class S>
CornerRing<S> best_quadrilateral_through(const Patch<S>& patch, int through);

/// The largest polygon of at most `most` corners, of any patch and `most` >= 2.
template <class S>
CornerRing<S> best_ring(const Patch<S>& patch, int most);

/// The same, of those that contain corner `through`.
template <class S>
CornerRing<S> best_ring_through(const Patch<S>& patch, int through, int most);

/// At most `most` corners whose convex hull together with `inner` has the largest area. `inner` is
/// in the patch; doubled_area is that of the hull.
template <class S>
CornerRing<S> best_ring_around(const Patch<S>& patch, const PlanePoint<S>& inner, int most);

/// The two corners farthest apart. One if they coincide.
template <class S>
CornerRing<S> farthest_pair(const Patch<S>& patch);

/// The corner farthest from a place.
template <class S>
int farthest_from(const Patch<S>& patch, const PlanePoint<S>& place);

}  // namespace contactscope
