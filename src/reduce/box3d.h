#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// As Box3D reduces the manifold of two hulls: area steps from a point that is far along a fixed
/// direction and deep, where a later point must win by 5%. Four points at most.
template <class S>
KeptIndices reduce_like_box3d(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                              const ReduceOptions& options);

}  // namespace contactscope
