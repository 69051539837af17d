#include "reduce/grow.h"

namespace contactscope {
namespace {

/// As Box3D reduces a cluster of contacts with a mesh, written from a description. Steps: the
/// farthest pair; the largest triangle; the most area outside. Four points at most. Deviation:
/// depth does not decide between near ties, because Box3D's tolerances for that are lengths.
template <class S>
KeptIndices reduce_like_box3d_mesh(ContactPoints<S> points, const Vec3<S>& normal,
                                   const ReduceOptions& options) {
  const auto [a, b] = steps::farthest_pair(points);
  KeptIndices kept;
  kept.push_back(a);
  if (a == b) return kept;
  kept.push_back(b);
  steps::grow<steps::Added::Area>(points, normal, 4, kept);
  return steps::first_of(kept, options);
}

}  // namespace

ReducerInfo box3d_mesh_reducer() {
  return {"box3d_mesh", "the farthest pair, largest triangle, most area",
          &reduce_like_box3d_mesh<float>, &reduce_like_box3d_mesh<double>};
}

}  // namespace contactscope
