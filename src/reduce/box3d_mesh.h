#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// As Box3D reduces a cluster of contacts with a mesh: area steps from the farthest pair. Four
/// points at most.
template <class S>
KeptIndices reduce_like_box3d_mesh(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                                   const ReduceOptions& options);

}  // namespace contactscope
