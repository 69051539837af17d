#pragma once

#include "geometry/mesh.h"

/// Hulls of simple shapes in their own frame, metres, centred on its origin; cylinders and cones
/// have the y axis. Faces are planar by construction. The same arguments give the same order of
/// vertices, edges and faces in every build. All functions throw ShapeError unless lengths are
/// positive and finite and 3 <= segments <= kMaxFaceVertices.
namespace contactscope {

/// The bits of i are the signs of vertex i (bit 0 = x, 1 = y, 2 = z; set = positive). Faces: +x,
/// -x, +y, -y, +z, -z, with normals exactly along the axes.
Hull<double> make_box(const Vec3d& half_extents);

/// Prism over a regular polygon with corners on the circle of `radius` in the x-z plane: corner 0
/// on +x, the others counter-clockwise seen from +y. Vertices: corner k is 2k at the bottom and 2k
/// + 1 at the top. Faces: +y cap, -y cap, then side k between corners k and k + 1.
Hull<double> make_cylinder(double radius, double half_height, int segments);

/// Pyramid over the same polygon: base at y = -half_height, apex at y = +half_height. Vertices:
/// corner k is k, and the apex is last. Faces: base, then side k.
Hull<double> make_cone(double radius, double half_height, int segments);

/// Maximum number of cells of a grid: four million triangles. A larger number is probably a typo.
inline constexpr int kMaxGridCells = 2'000'000;

/// Height field centred on the origin in the x-z plane, y up, metres; the front is above. `size`:
/// the whole side, divided into `cells` of two triangles each. Heights:
///   y = amplitude sin(3 tau x / size_x) cos(3 tau z / size_z), tau = 2 pi.
/// That is three waves along each side, exactly flat for amplitude 0. Vertex i + (cells_x + 1) j is
/// the i-th along +x in row j along +z. Cell c = i + cells_x j has triangles 2c, at the corner of
/// least x and z, and 2c + 1.
Mesh<double> make_grid(double size_x, double size_z, int cells_x, int cells_z, double amplitude);

}  // namespace contactscope
