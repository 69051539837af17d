#include "reduce/physx_cluster.h"

#include <array>

#include "reduce/steps.h"

namespace contactscope {

/// Behaviour of PhysX's cluster reduction, written from a description. Steps: the point farthest
/// from the centre, the farthest from it, and the farthest on either side of the line through both;
/// every point joins the nearest of these; the deepest of each cluster is kept. Deviations: the
/// centre is that of the points, because a reducer knows no frame of a shape; where a side is empty
/// three points come back; the clusters are listed by depth.
template <class S>
KeptIndices reduce_like_physx_cluster(std::span<const ContactPoint<S>> points,
                                      const Vec3<S>& normal, const ReduceOptions& options) {
  const Vec3<S> middle = steps::centre(points);
  const auto separation = [&](int i) { return points[static_cast<std::size_t>(i)].separation; };
  const auto apart = [&](int i, const Vec3<S>& from) {
    return (steps::at(points, i) - from).squaredNorm();
  };
  const int first =
      std::max(0, steps::highest(points, S(0), [&](int i) { return apart(i, middle); }));
  const int second = steps::farthest_from(points, first);
  KeptIndices centres;
  centres.push_back(first);
  steps::add_once(centres, second);
  for (const int side : steps::both_sides(points, normal, first, second)) {
    steps::add_once(centres, side);
  }

  KeptIndices deepest = centres;
  for (int i = 0; i < steps::count(points); ++i) {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < centres.size(); ++k) {
      if (apart(i, steps::at(points, centres[k])) < apart(i, steps::at(points, centres[nearest]))) {
        nearest = k;
      }
    }
    if (separation(i) < separation(deepest[nearest])) deepest[nearest] = i;
  }
  std::stable_sort(deepest.begin(), deepest.end(),
                   [&](int a, int b) { return separation(a) < separation(b); });
  return steps::first_of(deepest, options);
}

template KeptIndices reduce_like_physx_cluster(std::span<const ContactPoint<float>>,
                                               const Vec3<float>&, const ReduceOptions&);
template KeptIndices reduce_like_physx_cluster(std::span<const ContactPoint<double>>,
                                               const Vec3<double>&, const ReduceOptions&);

}  // namespace contactscope
