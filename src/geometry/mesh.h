#pragma once

#include "core/input_error.h"
#include "geometry/aabb_tree.h"
#include "geometry/hull.h"

namespace contactscope {

/// Shape of the surface across an edge of a triangle.
enum class EdgeClass : std::uint8_t {
  Boundary,  // the surface ends, or its continuation is unknown (see Mesh::neighbours)
  Internal,  // flat within kFlatEdgeAngle, or bent towards the front (concave)
  Convex,    // bent away from the front: another shape can touch the edge
};

/// Edges bent by less belong to the tessellation, not to the surface: radians, one degree. Contact
/// with such an edge takes the normal of a face, so this also bounds the error of that normal. Its
/// value comes from files: six digits or single precision make a normal uncertain by their rounding
/// over the triangle's height. With one degree a flat floor stays flat down to triangles ten
/// thousand times thinner than its length.
inline constexpr double kFlatEdgeAngle = 0.017453292519943295;

/// A triangle lower than this fraction of its longest edge is a sliver, with an uncertain normal.
inline constexpr double kSliver = 0.01;

/// Widest seam relative to the largest coordinate: the rounding of files with six digits.
inline constexpr double kSeam = 1e-6;

/// Triangles with one front side and shared edges, local frame, metres. Made by build_mesh, or by
/// build_mesh_with_flat_triangles, which keeps triangles without area. In both cases vectors with
/// an entry per triangle have the same size, and neighbours are mutual.
///
///          v[2]
///         /    |        Counter-clockwise seen from the front. Edge k runs from v[k] to
///     edge 2  edge 1    v[(k + 1) % 3]; so does entry k of neighbours and edges.
///       /        |
///     v[0]-edge 0-v[1]
template <class S> struct Mesh {
  std::vector<Vec3<S>> vertices;               // as given, unused ones included
  std::vector<std::array<int, 3>> triangles;   // vertex indices
  std::vector<std::array<int, 3>> neighbours;  // triangle across edge k. -1 on a boundary, where
                                               // more than two triangles share the edge, and where
                                               // the windings of two disagree
  std::vector<std::array<int, 3>> seams;       // triangle that continues the surface at an edge
                                               // without a neighbour, see find_seams(); -1: none.
                                               // Empty if all are -1. From triangle_count() on:
                                               // surfaces of other shapes, see join_seams()
  std::vector<Vec3<S>> normals;                // unit, to the front; zero if the area is zero. Then
                                               // those of the surfaces of other shapes
  std::vector<std::array<EdgeClass, 3>> edges;
  std::vector<int> regions;           // lowest triangle of the flat region: connected across edges
                                      // bent by at most kFlatEdgeAngle. An entry per normal
  std::vector<std::uint8_t> slivers;  // 1: lower than kSliver of the longest edge; otherwise 0
  AabbTree<S> tree;
  double seam = kSeam;  // how wide seams may be, see weld()
  int triangle_count() const { return static_cast<int>(triangles.size()); }
  /// Corner k, 0 <= k < 3, of a triangle.
  const Vec3<S>& corner(int triangle, int k) const {
    return at(vertices, at(at(triangles, triangle), k));
  }
  const Vec3<S>& normal(int triangle) const { return at(normals, triangle); }
  /// -1 for none.
  int neighbour(int triangle, int edge) const { return at(at(neighbours, triangle), edge); }
  /// The triangle in which the surface continues: the neighbour, or that across a seam; -1: none.
  int beyond(int triangle, int edge) const {
    const int across = neighbour(triangle, edge);
    return across >= 0 || seams.empty() ? across : at(at(seams, triangle), edge);
  }
  EdgeClass edge_class(int triangle, int edge) const { return at(at(edges, triangle), edge); }
  int region(int triangle) const { return at(regions, triangle); }
  bool is_sliver(int triangle) const { return at(slivers, triangle) != 0; }
};

/// Findings of build_mesh. None of them is an error.
struct MeshReport {
  /// Removed triangles, as ascending indices into the input. If one lay between two others with
  /// three corners on a line, these two now meet in a T-junction, see Mesh::seams.
  std::vector<int> zero_area_triangles;
  /// Per edge, the triangles that meet there, as ascending indices into Mesh::triangles; none has a
  /// neighbour across it. Non-manifold: more than two triangles. Flipped: two triangles with the
  /// same direction along the edge, so one of them is upside down.
  std::vector<std::vector<int>> non_manifold_edges, flipped_edges;
};

/// Builds a mesh from vertices (metres, local frame) and triangles (vertex indices,
/// counter-clockwise seen from the front). Keeps the order of both and removes triangles without
/// area (see triangle_normal). Vertices with equal coordinates count as one in the search for
/// neighbours, because many tools repeat a vertex for each of its triangles.
///
/// Throws ShapeError for a vertex index out of range, a coordinate that is not finite, an extent
/// that overflows, or a mesh in which no triangle has an area.
Mesh<double> build_mesh(std::vector<Vec3d> vertices, std::vector<std::array<int, 3>> triangles,
                        MeshReport* report = nullptr);

/// The same mesh in another scalar type; each vertex is rounded once. Normals and the boxes of the
/// tree come from the rounded triangles, so that plane and corners agree. A triangle that rounding
/// turns over keeps its old normal; one that loses its area gets a zero normal. Neighbours,
/// seams, edge classes and regions are copied, so that a flat floor far from the origin stays flat.
template <class T> Mesh<T> mesh_cast(const Mesh<double>& mesh);

/// Updates a mesh after its vertices moved: normals (zero for triangles without area), edge classes,
/// regions, slivers and the boxes of the tree. Neighbours stay, and so do seams that do not open.
template <class S> void refit(Mesh<S>& mesh);

/// Edge classes and regions, from neighbours, seams and normals.
template <class S> void classify_edges(Mesh<S>& mesh);

/// The same as refit() without the tree.
template <class S> void update_surface(Mesh<S>& mesh);

/// How to update the tree of a deformed mesh.
enum class TreeUpdate : std::uint8_t {
  Refit,    // same topology, new boxes
  Rebuild,  // a new tree
  Auto,     // refit; rebuild once the expected cost exceeds kWorstTreeCost times the original
};
inline constexpr double kWorstTreeCost = 1.3;

/// Updates only the tree of a mesh after its vertices moved. `cost_when_built` is expected_cost()
/// after the last build; a rebuild updates it. Returns true if the tree was rebuilt.
template <class S> bool update_tree(Mesh<S>& mesh, TreeUpdate how, double& cost_when_built);

/// Angle in radians between the normals of the two triangles at an edge beyond which there is one:
/// positive if convex, 0 if flat, the same from either triangle. Up to pi + kFlatEdgeAngle for a
/// sheet folded onto itself and slightly beyond; never near -pi.
template <class S> double bend_angle(const Mesh<S>& mesh, int triangle, int edge);

/// Unit normal of a triangle, to the side from which a, b, c run counter-clockwise, correct up to a
/// few roundings of its edges at every aspect ratio. Zero for a triangle without area: its height
/// over the longest edge is less than 128 roundings (units of 2^-52) of its largest coordinate.
/// Such a height can be rounding alone, and thinner triangles would have a normal uncertain by more
/// than kFlatEdgeAngle. The caller must reject infinite and huge coordinates.
Vec3d triangle_normal(const Vec3d& a, const Vec3d& b, const Vec3d& c);

// Triangles without area, from deformation or rounding, collide as segments and points.

template <class S> bool has_area(const Mesh<S>& mesh, int triangle) {
  return !mesh.normal(triangle).isZero(S(0));
}

/// Index of the longest edge. For a triangle without area it is the whole triangle.
template <class S> int longest_edge(const Mesh<S>& mesh, int triangle) {
  const auto squared = [&](int k) {
    return Vec3<S>(mesh.corner(triangle, (k + 1) % 3) - mesh.corner(triangle, k)).squaredNorm();
  };
  const int of_two = squared(1) > squared(0) ? 1 : 0;
  return squared(2) > squared(of_two) ? 2 : of_two;
}

/// Like build_mesh(), but keeps triangles without area, so the indices of the input stay valid.
Mesh<double> build_mesh_with_flat_triangles(std::vector<Vec3d> vertices,
                                            std::vector<std::array<int, 3>> triangles,
                                            MeshReport* report = nullptr);

/// Cuts a polygon, convex or not, into corners.size() - 2 triangles with the same winding: indices
/// into `corners`. At least three corners, nearly flat and not crossing; otherwise triangles may
/// overlap. Collinear corners give no triangle of zero area as long as another cut exists. O(n^2).
///
/// Source: ear clipping, Meisters 1975, "Polygons have ears".
std::vector<std::array<int, 3>> triangulate_polygon(std::span<const Vec3d> corners);

/// The same solid with every face cut into triangles, like a hull whose coplanar faces were never
/// merged. (Quickhull must merge while it grows, because the planes of slivers are unreliable.)
/// Vertices, centroid and radius stay; triangles are in the order of their faces. Each keeps the
/// plane of its face, so that triangles of one face tie exactly and rounding does not tilt slivers.
/// All invariants of Hull hold but one: an edge inside a face joins two faces with one plane.
///
/// A face stays whole if a cut would duplicate an existing edge. That happens only for faces that
/// overlap within the hull builder's tolerance, or for a hull without volume.
///
/// Clipping then uses only parts of the faces: Gregorius 2015, "Hull vs Hull: Coplanar Faces".
Hull<double> triangulate_faces(const Hull<double>& hull);

}  // namespace contactscope
