#pragma once

#include <array>

#include "core/vec3.h"

namespace contactscope {

/// The point of a simplex nearest to the origin, and the face of the simplex that carries it.
template <class S>
struct NearestOnSimplex {
  int count;                 // 1 a vertex, 2 an edge, 3 a triangle, 4: the origin is inside
  std::array<int, 4> kept;   // the first `count`: which points of the simplex, ascending
  std::array<S, 4> weights;  // the first `count`: barycentric, positive, of sum 1
  Vec3<S> point;             // zero when the origin is inside
  S squared_distance;
  /// Where from the origin the simplex lies, any length: the normal of a triangle where that is
  /// known better than the way to `point`, which near the origin is all rounding; else `point`.
  Vec3<S> direction;
};

/// Looks at the faces of the simplex that have its last point, because GJK adds one that brings the
/// simplex nearer. `points` are `count` points, 1 to 4; any of them may coincide or lie in one line
/// or plane. `scale` bounds the terms that they were differences of: rounding is relative to it.
/// Fourth powers of it must be in the range of S, and so must eps^2 times those.
template <class S>
void nearest_on_simplex(const std::array<Vec3<S>, 4>& points, int count, S scale,
                        NearestOnSimplex<S>& result);

}  // namespace contactscope
