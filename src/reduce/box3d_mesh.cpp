#include "reduce/box3d_mesh.h"

#include "reduce/grow.h"

namespace contactscope {

/// Behaviour of Box3D's mesh contacts, written from a description. Steps: the farthest pair; the
/// largest triangle; the most area outside. Deviation: depth does not decide between near ties,
/// because Box3D's tolerances for that are lengths.
template <class S>
KeptIndices reduce_like_box3d_mesh(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                                   const ReduceOptions& options) {
  const auto [a, b] = steps::farthest_pair(points);
  KeptIndices kept;
  kept.push_back(a);
  if (a == b) return kept;
  kept.push_back(b);
  steps::grow<steps::Added::Area>(points, normal, 4, kept);
  return steps::first_of(kept, options);
}

template KeptIndices reduce_like_box3d_mesh(std::span<const ContactPoint<float>>,
                                            const Vec3<float>&, const ReduceOptions&);
template KeptIndices reduce_like_box3d_mesh(std::span<const ContactPoint<double>>,
                                            const Vec3<double>&, const ReduceOptions&);

}  // namespace contactscope
