#pragma once

#include <array>
#include <vector>

#include "core/vec3.h"
#include "query/triangle_overlap.h"

namespace contactscope::test {

/// What two triangles share, in exact rational arithmetic: a as a polygon is clipped by the planes
/// that bound b, one after the other. Shares neither an algorithm nor arithmetic with the product.
struct ExactOverlap {
  TriangleOverlapKind kind = TriangleOverlapKind::None;
  std::vector<Vec3d> corners;  // of what they share, rounded; the same one may come twice

  /// The two corners that are farthest apart.
  std::array<Vec3d, 2> ends() const;
};
ExactOverlap exact_triangle_overlap(const Triangle<double>& a, const Triangle<double>& b);

}  // namespace contactscope::test
