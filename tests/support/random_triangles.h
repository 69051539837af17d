#pragma once

#include <utility>

#include "query/triangle_overlap.h"
#include "support/random_geometry.h"

namespace contactscope::test {

using TrianglePair = std::pair<Triangle<double>, Triangle<double>>;

template <class S> Triangle<S> rounded(const Triangle<double>& t) {
  return {t[0].template cast<S>(), t[1].template cast<S>(), t[2].template cast<S>()};
}

/// Kinds of random pairs of triangles.
enum class TrianglePairs {
  Random,          // corners anywhere in one cube
  Coplanar,        // in one coordinate plane, or exactly in one oblique plane
  Touching,        // a shared corner or edge, or a corner inside the other's edge or area
  NearlyCoplanar,  // b has its corners in the plane of a, up to a few last bits
  NearlyTouching,  // a corner of b on an edge or in the area of a, up to a few last bits
  Grid,            // corners on a grid of four points a side: every special case at once
  Degenerate,      // Grid, but one or both have collinear or equal corners
};
inline constexpr int kTrianglePairs = 7;

/// Two triangles of about `size` metres around `center`, rounded to float on request. With the
/// center at 0, Coplanar, Touching, Grid and Degenerate survive this rounding.
TrianglePair random_triangle_pair(Random& random, TrianglePairs how, double size,
                                  const Vec3d& center, bool in_float);

/// The mix of typical meshes: 92 % Random, 7 % Coplanar or Touching, 1 % NearlyCoplanar.
TrianglePairs draw_from_mix(Random& random);

}  // namespace contactscope::test
