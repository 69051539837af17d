#pragma once

#include <array>
#include <vector>

#include "core/vec3.h"
#include "geometry/hull.h"
#include "support/random_geometry.h"

namespace contactscope::test {

/// Vertices and triangles in the form for build_mesh.
struct MeshInput {
  std::vector<Vec3d> vertices;
  std::vector<std::array<int, 3>> triangles;

  /// Adds a triangle with vertices of its own.
  void add(const Vec3d& a, const Vec3d& b, const Vec3d& c);
};

/// Triangles of up to `size` metres in a cube of side `side` about `center`, none connected.
MeshInput random_soup(Random& random, int count, double side, double size, const Vec3d& center);

/// The same with one side up to a million times shorter than the others.
MeshInput random_slivers(Random& random, int count, double side, const Vec3d& center);

/// Triangles crowded towards the origin; each is ten per cent farther out and larger than the last.
MeshInput skewed_mesh(Random& random, int count);

/// The triangles of a hull whose faces are all triangles, in their order: edge k of triangle f
/// starts at vertex k of the face.
MeshInput triangles_of(const Hull<double>& hull);

/// A band of `quads` quads of two triangles, with its ends joined after half a turn.
MeshInput moebius_strip(int quads);

/// Two triangles on the common edge from (0, 0, 0) to (0, 0, -1), fronts up: one in the plane y =
/// 0, the other bent down across the edge by `angle` radians (up if negative).
MeshInput hinge(double angle);

}  // namespace contactscope::test
