#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/pose.h"
#include "geometry/mesh.h"
#include "geometry/shape.h"

namespace contactscope {

/// A shape and its place in the world.
struct PlacedSurface {
  Shape<double>* shape;
  Pose<double> pose;
  double seam = kSeam;  // of a hull; a mesh has its own
};

/// Finds where the surfaces of hulls and meshes continue each other, for shapes that never move
/// against each other: a floor of boxes, or of several meshes. What slides over such a floor must
/// not feel the edges between its parts. Sets Hull::seams, and adds to Mesh::seams. Steps:
/// 1. a face of a hull is covered if faces of other hulls lie against all of it: nothing can touch
///    it;
/// 2. a surface continues beyond an edge of a face that is not covered, or a boundary edge of a
///    mesh, in the other shapes' edges that lie on it, as in find_seams().
///
/// Gaps may be as wide as a seam, a share of the shape's largest coordinate in its own frame. An edge
/// on which others lie only in part has no seam. O(n^2) in shapes. Returns the indices of the shapes
/// with seams and of those that they are with, ascending: these have Hull::seams too, so that two
/// hulls of one surface are known as such.
std::vector<std::size_t> join_seams(std::span<const PlacedSurface> shapes);

}  // namespace contactscope
