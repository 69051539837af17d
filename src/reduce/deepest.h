#pragma once

#include <span>

#include "reduce/reducer.h"

namespace contactscope {

/// The deepest max_points points, deepest first, equally deep ones by index. Where two points
/// exchange their depth the manifold jumps.
template <class S>
KeptIndices reduce_to_deepest(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                              const ReduceOptions& options);

}  // namespace contactscope
