#include "reduce/optimal_ring.h"
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
/// hull, for no other point is a corner of the best polygon (Patch); the best of their rings
/// (largest_ring()); go round from the deepest of them.
template <class S>
KeptIndices reduce_to_optimal(ContactPoints<S> points, const Vec3<S>& normal,
                              const ReduceOptions& options) {
  if (options.max_points == 1) {
    KeptIndices kept;
    kept.push_back(steps::support_point(points, steps::fixed_direction(normal)));
    return kept;
  }
  const Patch<S> patch(points, normal);
  return points_of(patch, largest_ring(patch, options.max_points));
}

/// Of the choices of at most max_points points that contain the deepest point, the one whose convex
/// hull, seen along the normal, has the largest area: exact but for rounding. The deepest is the
/// one of least separation, the earliest of equals; it may be inside of the hull, also of the kept
/// ones. For two points the deepest and the one farthest from it; of points on one line the two
/// extremes and the deepest, if it is neither.
///
/// The deepest comes first. When it is a corner of the patch the others follow counter-clockwise
/// seen against the normal; when it is not they go round counter-clockwise from the next deepest.
///
/// As reduce_to_optimal(), with one point given: Gregorius 2015 begins with the deepest, too, and
/// then takes the farthest; here the others are chosen at once (largest_with()).
template <class S>
KeptIndices reduce_to_optimal_deepest(ContactPoints<S> points, const Vec3<S>& normal,
                                      const ReduceOptions& options) {
  const int deepest = steps::deepest_point(points);
  Patch<S> patch(points, normal);
  KeptIndices kept;
  largest_with(points, patch, deepest, options.max_points, kept);
  return kept;
}

}  // namespace

/// Those that choose all points at once.
std::vector<ReducerInfo> optimal_reducers() {
  return {{"optimal", "the largest area", &reduce_to_optimal<float>, &reduce_to_optimal<double>},
          {"optimal_deepest", "the largest area of those with the deepest",
           &reduce_to_optimal_deepest<float>, &reduce_to_optimal_deepest<double>}};
}

}  // namespace contactscope
