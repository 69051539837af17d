#include "reduce/grow.h"

namespace contactscope {
namespace {

template <class S>
constexpr S kHandicap = S(0.95);

/// As Box3D reduces the manifold of two hulls, written from a description. Steps: the point with
/// the largest sum of depth and way along a fixed direction in the plane; the farthest from it; the
/// largest triangle; the most area outside. A later point must beat an earlier one by 5%, so that
/// near ties do not flicker. Four points at most. Deviations: the way is measured from the centre
/// of the points, because a reducer knows no bodies; no point is left out for being too far apart.
template <class S>
KeptIndices reduce_like_box3d(ContactPoints<S> points, const Vec3<S>& normal,
                              const ReduceOptions& options) {
  const Vec3<S> direction = any_perpendicular(normal);
  const Vec3<S> middle = steps::centre(points);
  const int first = steps::highest(
      points, -std::numeric_limits<S>::infinity(),
      [&](int i) {
        return direction.dot(Vec3<S>(steps::position(points, i) - middle)) -
               at(points, i).separation;
      },
      kHandicap<S>);
  KeptIndices kept;
  kept.push_back(first);
  const int second = steps::farthest_from(points, first, kHandicap<S>);
  if (second == first) return kept;
  kept.push_back(second);
  steps::grow<steps::Added::Area>(points, normal, 4, kept, kHandicap<S>);
  return steps::first_of(kept, options);
}

}  // namespace

ReducerInfo box3d_reducer() {
  return {"box3d", "far and deep, farthest, largest triangle, most area, near ties to the earlier",
          &reduce_like_box3d<float>, &reduce_like_box3d<double>};
}

}  // namespace contactscope
