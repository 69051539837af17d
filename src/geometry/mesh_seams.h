#pragma once

#include "geometry/mesh.h"

namespace contactscope {

/// A seam is at most this wide, relative to the mesh's largest coordinate: the rounding of files
/// with six digits.
inline constexpr double kSeam = 1e-6;

/// An edge of a triangle.
struct TriangleEdge {
  int triangle, edge;
};

/// Mesh::seams of some boundary edges: where the surface continues although no edge is shared.
/// Either the vertices on both sides of a crack differ by rounding, or one long edge meets several
/// short ones in T-junctions.
///
///     +-----+-----+     Steps for an edge:
///     |   / |   / |     1. collect the other edges whose boxes meet its box;
///     | /   | /   |     2. of each in the other direction, take the part along the edge, if both
///     +-----T-----+        ends of that part are on the edge within the width of a seam;
///      \         /      3. if the parts leave no gap, and the surface bends equally at all of them
///        \     /           within kFlatEdgeAngle, it continues in the triangle of the longest.
///
/// Vertices and triangles stay as given. Triangles as thin as a seam have none. Empty if there are no
/// seams. `alone`: edges of one triangle each; the mesh's neighbours and normals are set. O(n log n)
/// unless very many edges meet.
template <class S>
std::vector<std::array<int, 3>> find_seams(const Mesh<S>& mesh,
                                           const std::vector<TriangleEdge>& alone);

}  // namespace contactscope
