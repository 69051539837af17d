#pragma once

#include "geometry/shape.h"

namespace contactscope {

/// An edge of a triangle.
struct TriangleEdge {
  int triangle, edge;
};

/// An edge of a surface, which is to the left of it, seen from the surface's front.
struct SurfaceEdge {
  Vec3d from, along;  // metres
  Vec3d normal;       // unit, of the surface at the edge
};

/// Width of a seam at an edge, at most `widest`, metres; less where edges are as short as seams.
double seam_width(const SurfaceEdge& edge, double widest);

/// Steps 2 and 3 of find_seams: the near edge in which the surface continues; -1: none.
int continuation(const SurfaceEdge& edge, const std::vector<SurfaceEdge>& near, double width);

/// The widest seam of these edges, metres.
template <class S> double widest_seam(const Mesh<S>& mesh, const std::vector<TriangleEdge>& edges);

/// The edges whose triangle is wider than a seam: the sides of a strip as narrow as one
/// would be a seam of it with itself. `edges` is shortened to the same.
template <class S>
std::vector<SurfaceEdge> edges_of_wide_triangles(const Mesh<S>& mesh,
                                                 std::vector<TriangleEdge>& edges);

/// Mesh::seams: boundary edges where the surface continues although no edge is shared. The sides of
/// a crack differ by rounding, or one long edge meets several short ones in T-junctions.
///
///     +-----+-----+     Steps for an edge:
///     |   / |   / |     1. collect the other edges whose boxes meet its box;
///     | /   | /   |     2. of each in the other direction, take the part along the edge, if both
///     +-----T-----+        ends of that part are on the edge within the width of a seam;
///      \         /      3. if the parts leave no gap, and the surface bends equally at all of them
///        \     /           within kFlatEdgeAngle, it continues in the triangle of the longest.
///
/// Vertices and triangles stay as given; those as thin as a seam have none. Empty without seams.
/// `alone`: edges of one triangle each. Edges of other surfaces, in the mesh's frame, are numbered
/// from triangle_count() on. O(n log n) unless very many edges meet.
template <class S>
std::vector<std::array<int, 3>> find_seams(const Mesh<S>& mesh, std::vector<TriangleEdge> alone,
                                           const std::vector<SurfaceEdge>& others = {});

/// Finds the seams of a mesh again, as wide as this share of its largest coordinate.
void weld(Mesh<double>& mesh, double seam);

/// The edges without a neighbour and without a seam.
std::vector<TriangleEdge> lone_edges(const Mesh<double>& mesh);

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
/// Gaps may be as wide as a seam, relative to the shape in its own frame. An edge on which others
/// lie only in part has no seam. O(n^2) in shapes. Returns the indices of the shapes with seams and
/// of their partners, ascending: these have Hull::seams too.
std::vector<std::size_t> join_seams(std::span<const PlacedSurface> shapes);

}  // namespace contactscope
