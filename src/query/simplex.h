#pragma once

#include "core/vec3.h"

namespace contactscope {

/// The point of a simplex closest to the origin, and the face of the simplex that contains it.
template <class S> struct NearestOnSimplex {
  int count;                 // 1: vertex, 2: edge, 3: triangle, 4: the origin is inside
  std::array<int, 4> kept;   // first `count` entries: indices of simplex points, ascending
  std::array<S, 4> weights;  // first `count` entries: barycentric, positive, sum 1
  Vec3<S> point;             // zero if the origin is inside
  S squared_distance;
  /// From the origin towards the simplex, any length: `point`, or a triangle's normal where that is
  /// more accurate, because near the origin `point` is all rounding.
  Vec3<S> direction;
};

/// Considers only the faces that contain the last point, because GJK adds a point that brings the
/// simplex closer. `points` are `count` points, 1 to 4, possibly coincident, collinear or coplanar.
/// `scale` bounds the terms that they were differences of: rounding is relative to it. Its fourth
/// power, also times eps^2, must be in the range of S.
template <class S>
void nearest_on_simplex(const std::array<Vec3<S>, 4>& points, int count, S scale,
                        NearestOnSimplex<S>& result);

}  // namespace contactscope
