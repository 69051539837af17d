#pragma once

#include <cstdint>
#include <vector>

#include "core/pose.h"
#include "geometry/mesh.h"

namespace contactscope {

/// How often a surface goes around a point.
struct Winding {
  /// 1 inside a watertight mesh with its fronts outside, 0 outside, -1 inside one with its fronts
  /// inside; parts inside each other add up. Of a mesh with open edges it only counts what is
  /// above the point. Without meaning where the point is on the surface.
  int number = 0;
  bool on_surface = false;  // exactly
};

/// Winding number of a mesh around a point (mesh's frame), exact for the numbers as given: the
/// triangles that a ray along +z crosses, those that it leaves through their front less those that
/// it enters. Signs of orient2d and orient3d decide; where the ray meets an edge or a vertex, the
/// point is moved by (e, e^2, 0) with an infinitely small e, which says for each of the triangles
/// there whether it is crossed, so that exactly the right ones are.
///
/// Source of the perturbation: Edelsbrunner and Muecke 1990, "Simulation of Simplicity". Visits the
/// triangles whose boxes are above the point.
template <class S>
Winding winding_number(const Mesh<S>& mesh, const Vec3<S>& point);

struct MeshEdge {
  int triangle = -1;
  int edge = -1;

  friend bool operator==(const MeshEdge&, const MeshEdge&) = default;
};

/// Edges with no neighbour across (see Mesh::neighbours), by triangle: where a mesh has holes, or
/// nobody can say how it goes on. None of them: the mesh is watertight, and has an inside.
template <class S>
std::vector<MeshEdge> open_edges(const Mesh<S>& mesh);

/// How two meshes lie to each other of which no triangles share a point.
enum class Containment : std::uint8_t {
  Apart,      // no part of one is inside the other
  AInB,       // some connected part of a is inside b
  BInA,       // some connected part of b is inside a
  AHasHoles,  // a has open edges, so that it has no inside; nothing is said
  BHasHoles,  // b has, and a has none
};

/// Whether one mesh is inside the other, given that mesh_overlap found no triangles that share a
/// point: by the winding number around a vertex of each connected part. Vertices of b are those of
/// vertices_in, as there. Inside is where the winding number is not 0.
template <class S>
Containment mesh_containment(const Mesh<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a);

}  // namespace contactscope
