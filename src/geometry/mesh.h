#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/input_error.h"
#include "core/vec3.h"
#include "geometry/aabb_tree.h"

namespace contactscope {

/// How the surface goes on across an edge of a triangle.
enum class EdgeClass : std::uint8_t {
  Boundary,  // it ends here, or nobody can say how it goes on (see Mesh::neighbours)
  Internal,  // flat, or nearly: kFlatEdgeAngle; or bent towards the front (concave)
  Convex,    // bent away from the front: another shape can touch the edge
};

/// Edges that are bent by less are no edges of the surface, but of its tessellation: radians, one
/// degree. Contact with such an edge takes the normal of a face, so this is also how far that
/// normal may be off. It is an angle, so that it holds at every scale, and its value is what files
/// need: coordinates written with six digits, or stored in single precision, leave the normal of a
/// triangle uncertain by their rounding over its height, so that a flat floor stays flat down to
/// triangles ten thousand times thinner than the floor is long.
inline constexpr double kFlatEdgeAngle = 0.017453292519943295;

/// Triangles with one front side and shared edges, local frame, metres. Made by build_mesh, or by that
/// of flat_triangle.h, which keeps triangles without an area; both promise that vectors with an entry
/// for each triangle have the same size, and that neighbours are mutual.
///
///          v[2]
///         /    |        counter-clockwise seen from the front; edge k runs from v[k] to
///     edge 2  edge 1    v[(k + 1) % 3], and so does entry k of neighbours and edges
///       /        |
///     v[0]-edge 0-v[1]
template <class S>
struct Mesh {
  std::vector<Vec3<S>> vertices;               // as given, unused ones included
  std::vector<std::array<int, 3>> triangles;   // vertex indices
  std::vector<std::array<int, 3>> neighbours;  // triangle across edge k. -1 on a boundary, where
                                               // more than two triangles share the edge, and where
                                               // the windings of two disagree
  std::vector<Vec3<S>> normals;                // unit, to the front; zero without an area
  std::vector<std::array<EdgeClass, 3>> edges;
  AabbTree<S> tree;

  int triangle_count() const { return static_cast<int>(triangles.size()); }
  /// Corner k, 0 <= k < 3, of a triangle.
  const Vec3<S>& corner(int triangle, int k) const {
    return at(vertices, at(at(triangles, triangle), k));
  }
  const Vec3<S>& normal(int triangle) const { return at(normals, triangle); }
  /// -1 for none.
  int neighbour(int triangle, int edge) const { return at(at(neighbours, triangle), edge); }
  EdgeClass edge_class(int triangle, int edge) const { return at(at(edges, triangle), edge); }
};

/// What build_mesh found on the way. None of it is an error.
struct MeshReport {
  /// Dropped; indices into the input, ascending. Where one stood between two others as three
  /// corners on a line, those meet in a T-junction now, which is a boundary to both.
  std::vector<int> zero_area_triangles;
  /// For each such edge of the surface the triangles that meet there (indices into Mesh::triangles,
  /// ascending), none of which has a neighbour across it: more than two of them, or two that run
  /// along it the same way, so that one is turned over.
  std::vector<std::vector<int>> non_manifold_edges, flipped_edges;
};

/// A mesh from vertices (metres, local frame) and triangles (vertex indices, counter-clockwise seen
/// from the front). The order of both is kept; triangles without an area (see triangle_normal) are
/// left out. Vertices with equal coordinates count as one when neighbours are sought, because many
/// tools repeat a vertex for each of its triangles.
///
/// Throws ShapeError for a vertex that does not exist, a coordinate that is not finite or an extent
/// that overflows, and where no triangle has an area.
Mesh<double> build_mesh(std::vector<Vec3d> vertices, std::vector<std::array<int, 3>> triangles,
                        MeshReport* report = nullptr);

/// The same mesh in another scalar: vertices are rounded once each. Normals are those of the
/// rounded triangles, so that plane and corners agree, but for those that rounding turns over, which
/// keep what they had; a triangle that loses its area by rounding has none. Neighbours and classes of edges are
/// those of the original, so that a flat floor far from the origin stays one. The tree's boxes are
/// those of the rounded triangles.
template <class T>
Mesh<T> mesh_cast(const Mesh<double>& mesh);

/// Brings a mesh up to date whose vertices were moved: normals (zero for triangles without an area),
/// classes of edges, boxes of the tree. Neighbours stay what they were.
template <class S>
void refit(Mesh<S>& mesh);

/// The same but for the tree.
template <class S>
void update_surface(Mesh<S>& mesh);

/// What becomes of a tree whose mesh was deformed.
enum class TreeUpdate : std::uint8_t {
  Refit,    // the same tree, with boxes made anew
  Rebuild,  // a new tree
  Auto,     // refitted, and built anew once it has become kWorstTreeCost times as expensive
};
inline constexpr double kWorstTreeCost = 1.3;

/// Brings the tree of a mesh up to date whose vertices were moved, and nothing else of the mesh.
/// `cost_when_built` is AabbTree::expected_cost() of the tree as it was built last; it is kept
/// up to date here. Returns whether the tree was built anew.
template <class S>
bool update_tree(Mesh<S>& mesh, TreeUpdate how, double& cost_when_built);

/// Angle in radians by which the surface bends across an edge that has a neighbour: the one between
/// the normals of both triangles, positive where convex, 0 where flat. The same seen from either
/// triangle. Over pi for a sheet folded onto itself and beyond by up to kFlatEdgeAngle, never near
/// -pi.
template <class S>
double bend_angle(const Mesh<S>& mesh, int triangle, int edge);

/// Unit normal of a triangle, to the side from which a, b, c run counter-clockwise, correct to a
/// few roundings of its edges for every aspect; zero for a triangle without an area: one whose
/// height over its longest edge is less than 128 roundings (units of 2^-52) of its largest
/// coordinate. That much can be rounding alone, and any thinner one would have a normal that is
/// uncertain by more than kFlatEdgeAngle. Infinite and huge coordinates are the caller's to refuse.
Vec3d triangle_normal(const Vec3d& a, const Vec3d& b, const Vec3d& c);

}  // namespace contactscope
