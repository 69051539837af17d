#pragma once

#include <utility>

#include "query/triangle_overlap.h"
#include "support/random_geometry.h"

namespace contactscope::test {

using TrianglePair = std::pair<Triangle<double>, Triangle<double>>;

template <class S>
Triangle<S> rounded(const Triangle<double>& t) {
  return {t[0].template cast<S>(), t[1].template cast<S>(), t[2].template cast<S>()};
}

/// How a random pair of triangles is made.
enum class TrianglePairs {
  Random,          // corners anywhere in one cube
  Coplanar,        // in one coordinate plane, or exactly in one oblique plane
  Touching,        // a shared corner or edge, or a corner in the middle of the other's edge or area
  NearlyCoplanar,  // b has its corners in the plane of a, up to a few last bits
  NearlyTouching,  // a corner of b on an edge or in the area of a, up to a few last bits
  Grid,            // corners on a grid of four points a side: every special case at once
  Degenerate,      // Grid, where one or both have three corners on a line, or equal
};
inline constexpr int kTrianglePairs = 7;

/// Two triangles of about `size` metres around `center`, rounded to float where asked for, which
/// leaves Coplanar, Touching, Grid and Degenerate what they are where the center is 0.
TrianglePair random_triangle_pair(Random& random, TrianglePairs how, double size,
                                  const Vec3d& center, bool in_float);

/// A mix as meshes give it: 92 % Random, 7 % Coplanar or Touching, 1 % NearlyCoplanar.
TrianglePairs draw_from_mix(Random& random);

}  // namespace contactscope::test
