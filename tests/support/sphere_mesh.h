#pragma once

#include "core/pose.h"
#include "geometry/mesh.h"

namespace contactscope::test {

/// A closed sphere about the origin of its frame, poles on z, fronts outside: `meridians` vertices
/// around, `parallels` between the poles, 2 meridians parallels triangles. The radius, in metres,
/// varies by the fraction `waves`, three times around and twice from pole to pole.
struct SphereMesh {
  std::vector<Vec3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};
SphereMesh sphere_mesh(double radius, int meridians, int parallels, double waves);
Mesh<double> built(const SphereMesh& sphere);

/// A watertight cube of twelve triangles about the origin.
Mesh<double> cube_mesh(double half_side);

/// Two spheres of 9,680 triangles and radius 1 m that intersect.
struct SpherePair {
  Mesh<double> a, b;
  Pose<double> b_in_a;
};
/// Their centres are 1.2 m from each other: they intersect in a circle.
SpherePair crossing_spheres();
/// Concentric, both wavy and one turned: the surfaces cross everywhere.
SpherePair concentric_spheres();

}  // namespace contactscope::test
