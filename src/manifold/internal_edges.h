#pragma once

#include "geometry/mesh.h"

namespace contactscope {

/// Whether a contact normal can come from a mesh, or only from one of its triangles alone. A
/// triangle that is looked at by itself has edges and corners that the surface does not have: a box
/// that slides over a flat floor trips over them. Source: Terdiman, "Contact generation for meshes".
///
/// `normal` (unit, from the mesh to the other shape, mesh frame) touches the feature of the triangle
/// that lies farthest along it: the face, an edge or a corner. The surface has that feature when no
/// vertex of the triangles around it lies farther along the normal. That is so for the face; never
/// for an edge in a flat or hollow place; for a ridge or a peak where the normal lies between those
/// of its faces. Where the surface ends, the edge is its own.
///
/// We ask the vertices and not, as is usual, the angles between the faces: that serves corners as
/// well as edges, and both sides of a triangle.
template <class S>
bool belongs_to_surface(const Mesh<S>& mesh, int triangle, const Vec3<S>& normal);

/// Whether another triangle stands between `eye` and the point `on_triangle` of a triangle, so that
/// what has its centre at `eye` cannot have come to that side of it. Asks no winding. Mesh frame.
template <class S>
bool hidden_from(const Mesh<S>& mesh, int triangle, const Vec3<S>& eye, const Vec3<S>& on_triangle);

/// Whether any of the mesh is nearer to `point` than `distance`. Mesh frame, metres.
template <class S>
bool surface_within(const Mesh<S>& mesh, const Vec3<S>& point, S distance);

}  // namespace contactscope
