#include "reduce/optimal_choice.h"
#include "reduce/steps.h"

namespace contactscope {
namespace {

/// The max_points points whose convex hull, seen along the normal, has the largest area of all such
/// choices: exact but for rounding, at O(n^2) for four points. Of two choices whose areas differ by
/// less than the rounding of S (in float some 1e-7 of the area) the smaller may be taken. For two
/// points the farthest pair, for one a support point in a fixed direction, which rolls over with
/// the smallest change of the patch least. Points that would add no area are left out: all corners
/// of the hull if there are no more than max_points, the two extremes of points on one line, one of
/// coincident ones.
///
/// Counter-clockwise seen against the normal, beginning with the deepest of those kept (the
/// earliest of equally deep ones). Separations are not looked at otherwise.
///
/// The talk grows four points one by one (Gregorius 2015, "Contact Point Reduction"); here they are
/// chosen at once. Steps: project the points into the plane and take the corners of their convex
/// hull, for no other point is a corner of the best polygon (Patch); four of them by rolling a line
/// round the hull (Shamos 1978, see best_quadrilateral()), another number by the longest chain of
/// edges (best_ring()), two by trying all pairs; go round from the deepest of them.
template <class S>
KeptIndices reduce_to_optimal(ContactPoints<S> points, const Vec3<S>& normal,
                              const ReduceOptions& options) {
  if (options.max_points == 1) {
    KeptIndices kept;
    kept.push_back(steps::support_point(points, steps::fixed_direction(normal)));
    return kept;
  }
  const Patch<S> patch(points, normal);
  return kept_points(points, patch, largest_ring(patch, options.max_points));
}

}  // namespace

ReducerInfo optimal_reducer() {
  return {"optimal", "the largest area", &reduce_to_optimal<float>, &reduce_to_optimal<double>};
}

}  // namespace contactscope
