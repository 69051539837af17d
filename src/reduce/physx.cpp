#include "reduce/steps.h"

namespace contactscope {
namespace {

/// As PhysX reduces a batch of contacts, written from a description. Steps: the deepest point,
/// which is therefore always kept; the farthest from it; the farthest on either side of the line
/// through both. Four points at most. Deviation: where a side is empty three points come back.
template <class S>
KeptIndices reduce_like_physx(ContactPoints<S> points, const Vec3<S>& normal,
                              const ReduceOptions& options) {
  const int first = steps::deepest_point(points);
  const int second = steps::farthest_from(points, first);
  return steps::two_and_both_sides(points, normal, first, second, options);
}

}  // namespace

ReducerInfo physx_reducer() {
  return {"physx", "the deepest, farthest, then both sides", &reduce_like_physx<float>,
          &reduce_like_physx<double>};
}

}  // namespace contactscope
