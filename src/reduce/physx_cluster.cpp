#include <array>

#include "reduce/steps.h"

namespace contactscope {
namespace {

/// As PhysX reduces contacts by clusters, written from a description. Steps: the point farthest
/// from the centre, the farthest from it, and the farthest on either side of the line through both;
/// every point joins the nearest of these; the deepest of each cluster is kept, so that the deepest
/// of all always is, first. Four points at most. Deviations: the centre is that of the points,
/// because a reducer knows no frame of a shape; where a side is empty three points come back; the
/// clusters are listed by depth.
template <class S>
KeptIndices reduce_like_physx_cluster(ContactPoints<S> points, const Vec3<S>& normal,
                                      const ReduceOptions& options) {
  const Vec3<S> middle = steps::centre(points);
  const auto separation = [&](int i) { return at(points, i).separation; };
  const auto apart = [&](int i, const Vec3<S>& from) {
    return (steps::position(points, i) - from).squaredNorm();
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
  for (int i = 0; i < count_of(points); ++i) {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < centres.size(); ++k) {
      if (apart(i, steps::position(points, centres[k])) <
          apart(i, steps::position(points, centres[nearest]))) {
        nearest = k;
      }
    }
    if (separation(i) < separation(deepest[nearest])) deepest[nearest] = i;
  }
  std::stable_sort(deepest.begin(), deepest.end(),
                   [&](int a, int b) { return separation(a) < separation(b); });
  return steps::first_of(deepest, options);
}

}  // namespace

ReducerInfo physx_cluster_reducer() {
  return {"physx_cluster", "the deepest of each of four clusters",
          &reduce_like_physx_cluster<float>, &reduce_like_physx_cluster<double>};
}

}  // namespace contactscope
