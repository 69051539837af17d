#pragma once

#include "geometry/mesh.h"

namespace contactscope {

/// Number of times that a surface winds around a point.
struct Winding {
  /// 1 inside a watertight mesh with its fronts outside, 0 outside, -1 inside one with its fronts
  /// inside; nested parts add up. For a mesh with open edges it only counts crossings above the
  /// point. Undefined if the point is on the surface.
  int number = 0;
  bool on_surface = false;  // exactly
};

/// Exact winding number of a mesh around a point (mesh's frame): of the triangles crossed by a ray
/// along +z, the number that it leaves through their front minus the number that it enters. The
/// point is moved by (e, e^2, 0) with an infinitesimal e, so the ray hits no edge or vertex.
///
/// Perturbation: Edelsbrunner and Muecke 1990, "Simulation of Simplicity".
template <class S> Winding winding_number(const Mesh<S>& mesh, const Vec3<S>& point);

struct MeshEdge {
  int triangle = -1;
  int edge = -1;
  friend bool operator==(const MeshEdge&, const MeshEdge&) = default;
};

/// Edges without a neighbour (see Mesh::neighbours), sorted by triangle: holes, or places where the
/// continuation is unknown. If there are none, the mesh is watertight and has an inside.
template <class S> std::vector<MeshEdge> open_edges(const Mesh<S>& mesh);

/// Relative position of two meshes that do not intersect.
enum class Containment : std::uint8_t {
  Separation,  // no part of either mesh is inside the other
  AInB,        // a connected part of a is inside b
  BInA,        // a connected part of b is inside a
  AHasHoles,   // a has open edges and therefore no inside; unknown
  BHasHoles,   // b has open edges, a has none
};

/// Tests if one mesh is inside the other, if mesh_overlap found no intersection: computes the
/// winding number around a vertex of each connected part. Inside means that it is not 0. The
/// vertices of b are those of vertices_in, as in mesh_overlap.
template <class S>
Containment mesh_containment(const Mesh<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a);

}  // namespace contactscope
