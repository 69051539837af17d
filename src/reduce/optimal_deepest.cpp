#include "reduce/optimal_choice.h"
#include "reduce/steps.h"

namespace contactscope {
namespace {

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
/// then takes the farthest; here the others are chosen at once. Steps: find the deepest; where it
/// is a corner of the hull, a quadrilateral with it has it at an end of a diagonal, so only
/// diagonals from it are tried (best_quadrilateral_through()); where it is not, the ring of one
/// corner less whose hull with it is the largest (best_ring_around()).
template <class S>
KeptIndices reduce_to_optimal_deepest(ContactPoints<S> points, const Vec3<S>& normal,
                                      const ReduceOptions& options) {
  const int deepest = steps::deepest_point(points);
  Patch<S> patch(points, normal);
  const ChoiceWith<S> choice = largest_with(points, patch, deepest, options.max_points);
  return kept_points(points, patch, choice, deepest);
}

}  // namespace

ReducerInfo optimal_deepest_reducer() {
  return {"optimal_deepest", "the largest area of those with the deepest",
          &reduce_to_optimal_deepest<float>, &reduce_to_optimal_deepest<double>};
}

}  // namespace contactscope
