#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// As PhysX reduces contacts by clusters: four points that span the patch, the others clustered
/// around them, and the deepest of each cluster. The deepest of all is always kept, first. Four
/// points at most.
template <class S>
KeptIndices reduce_like_physx_cluster(std::span<const ContactPoint<S>> points,
                                      const Vec3<S>& normal, const ReduceOptions& options);

}  // namespace contactscope
