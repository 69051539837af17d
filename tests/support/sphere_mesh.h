#pragma once

#include "core/pose.h"
#include "geometry/mesh.h"

namespace contactscope::test {

/// Vertices and triangles of a closed sphere about the origin of its frame, poles on z, fronts
/// outside: `meridians` of them around, `parallels` between the poles, 2 meridians parallels
/// triangles. The radius, in metres, swells and shrinks by the part `waves` of it, three times
/// around and twice from pole to pole.
struct SphereMesh {
  std::vector<Vec3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};
SphereMesh sphere_mesh(double radius, int meridians, int parallels, double waves);
Mesh<double> built(const SphereMesh& sphere);

/// A watertight cube of twelve triangles, about the origin.
Mesh<double> cube_mesh(double half_side);

/// Two spheres of 9,680 triangles and radius 1 m, in each other.
struct SpherePair {
  Mesh<double> a, b;
  Pose<double> b_in_a;
};
/// Their centres are 1.2 m apart: they cut each other in a circle.
SpherePair crossing_spheres();
/// Concentric, both wavy and one turned: surfaces that cross all over.
SpherePair concentric_spheres();

}  // namespace contactscope::test
