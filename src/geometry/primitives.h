#pragma once

#include "core/vec3.h"
#include "geometry/hull.h"
#include "geometry/shape_error.h"

/// Hulls of simple shapes in their own frame, metres, centred on the origin of it; the axis of
/// cylinder and cone is y. Faces are planar by construction. The same arguments give the same
/// order of vertices, edges and faces, in every build. All throw ShapeError unless lengths are
/// positive and finite and 3 <= segments <= kMaxFaceVertices.
namespace contactscope {

/// Vertex i has the signs of the bits of i (bit 0 = x, 1 = y, 2 = z; set = positive). Faces: +x,
/// -x, +y, -y, +z, -z, their normals exactly the axes.
Hull<double> make_box(const Vec3d& half_extents);

/// Prism over a regular polygon whose corners lie on the circle of `radius` in the x-z plane,
/// corner 0 on +x, the others counter-clockwise seen from +y. Vertices: corner k at the bottom is
/// 2k, at the top 2k + 1. Faces: +y cap, -y cap, then side k between corners k and k + 1.
Hull<double> make_cylinder(double radius, double half_height, int segments);

/// Pyramid over the same polygon: base at y = -half_height, apex at y = +half_height. Vertices:
/// corner k is k, the apex comes last. Faces: base, then side k.
Hull<double> make_cone(double radius, double half_height, int segments);

}  // namespace contactscope
