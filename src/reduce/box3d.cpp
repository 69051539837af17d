#include "reduce/box3d.h"

#include "reduce/grow.h"

namespace contactscope {
namespace {

template <class S>
constexpr S kHandicap = S(0.95);

}  // namespace

/// Behaviour of Box3D's convex manifolds, written from a description. Steps: the point with the
/// largest sum of depth and way along a fixed direction in the plane; the farthest from it; the
/// largest triangle; the most area outside. A later point must beat an earlier one by 5%, so that
/// near ties do not flicker. Deviations: the way is measured from the centre of the points, because
/// a reducer knows no bodies; no point is left out for being too far apart.
template <class S>
KeptIndices reduce_like_box3d(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                              const ReduceOptions& options) {
  const Vec3<S> direction = any_perpendicular(normal);
  const Vec3<S> middle = steps::centre(points);
  const int first = steps::highest(
      points, -std::numeric_limits<S>::infinity(),
      [&](int i) {
        return direction.dot(Vec3<S>(steps::at(points, i) - middle)) -
               points[static_cast<std::size_t>(i)].separation;
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

template KeptIndices reduce_like_box3d(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                       const ReduceOptions&);
template KeptIndices reduce_like_box3d(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                       const ReduceOptions&);

}  // namespace contactscope
