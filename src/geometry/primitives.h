#pragma once

#include "core/input_error.h"
#include "core/vec3.h"
#include "geometry/hull.h"
#include "geometry/mesh.h"

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

/// Cells that a grid may have at most: four million triangles, beyond which a slip of the pen is
/// likelier than a wish.
inline constexpr int kMaxGridCells = 2'000'000;

/// Height field centred on the origin of its frame in the x-z plane, y up, metres; the front is
/// above. `size` is the whole side, cut into `cells` equal ones of two triangles each;
/// y = amplitude sin(3 tau x / size_x) cos(3 tau z / size_z), three waves along each side (tau = 2
/// pi), exactly flat for amplitude 0. Vertex i + (cells_x + 1) j is the i-th along +x in row j
/// along +z; cell i + cells_x j is triangles 2 (i + cells_x j), at the corner of least x and z, and
/// the next one.
///
/// Throws ShapeError unless sizes are positive and finite, the amplitude finite,
/// and the cells at least one along each side and kMaxGridCells together.
Mesh<double> make_grid(double size_x, double size_z, int cells_x, int cells_z, double amplitude);

}  // namespace contactscope
