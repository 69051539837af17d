#pragma once

#include <array>
#include <vector>

#include "core/vec3.h"
#include "query/triangle_overlap.h"

namespace contactscope::test {

/// Intersection of two triangles in exact rational arithmetic: the planes that bound b clip the
/// polygon a one after the other. Shares neither an algorithm nor arithmetic with the product.
struct ExactOverlap {
  TriangleOverlapKind kind = TriangleOverlapKind::None;
  std::vector<Vec3d> corners;  // of the intersection, rounded; may contain duplicates

  /// The two corners with the largest distance.
  std::array<Vec3d, 2> ends() const;
};
ExactOverlap exact_triangle_overlap(const Triangle<double>& a, const Triangle<double>& b);

}  // namespace contactscope::test
