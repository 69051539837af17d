#include "query/winding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "query/mesh_overlap.h"
#include "support/random_geometry.h"
#include "support/sphere_mesh.h"

namespace contactscope {
namespace {

using test::built;
using test::cube_mesh;
using test::Random;

/// Sum of the triangles' solid angles seen from a point, over 4 pi: van Oosterom and Strackee 1983,
/// "The Solid Angle of a Plane Triangle".
double winding_by_solid_angle(const Mesh<double>& mesh, const Vec3d& point) {
  double angle = 0;
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    const Vec3d a = at(mesh.vertices, triangle[0]) - point,
                b = at(mesh.vertices, triangle[1]) - point,
                c = at(mesh.vertices, triangle[2]) - point;
    angle +=
        2 * std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                              b.dot(c) * a.norm() + c.dot(a) * b.norm());
  }
  return angle / (4 * std::numbers::pi);
}

TEST(Winding, RaysThroughEdgesAndVerticesCountOnce) {
  // The rays from these points meet the diagonal, an edge, a corner or a side of the cube.
  const Mesh<double> cube = cube_mesh(1);
  for (const double x : {-2., -1., -0.5, 0., 0.5, 1., 2.}) {
    for (const double y : {-2., -1., -0.5, 0., 0.5, 1., 2.}) {
      for (const double z : {-2., -1., -0.5, 0., 0.5, 1., 2.}) {
        const Vec3d point(x, y, z);
        const double farthest = point.cwiseAbs().maxCoeff();
        const Winding winding = winding_number(cube, point);
        EXPECT_EQ(winding.on_surface, farthest == 1) << point.transpose();
        if (farthest != 1) {
          EXPECT_EQ(winding.number, farthest < 1 ? 1 : 0) << point.transpose();
        }
      }
    }
  }
}

TEST(Winding, OneLastBitDecides) {
  const Mesh<double> cube = cube_mesh(1);
  EXPECT_EQ(winding_number(cube, Vec3d(0.25, 0.125, std::nextafter(1, 0))).number, 1);
  EXPECT_EQ(winding_number(cube, Vec3d(0.25, 0.125, std::nextafter(1, 2))).number, 0);
  EXPECT_EQ(winding_number(cube, Vec3d(std::nextafter(1, 0), 1, 0.5)).on_surface, true);
  EXPECT_EQ(winding_number(cube, Vec3d(std::nextafter(1, 0), std::nextafter(1, 0), 0.5)).number, 1);
}

TEST(Winding, SlowAgreesWithSolidAngles) {
  Random random(61);
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    const double size = random.decade(-4, 4);
    test::SphereMesh sphere = test::sphere_mesh(size, 9, 6, 0.3);
    const Pose<double> pose = random.pose(size);
    for (Vec3d& vertex : sphere.vertices) vertex = pose.transform(vertex);
    if (random.chance(0.5))
      for (std::array<int, 3>& triangle : sphere.triangles) std::swap(triangle[0], triangle[1]);
    const Mesh<double> mesh = built(sphere);
    for (int k = 0; k < 20; ++k) {
      const Vec3d point = pose.position + 1.3 * size * random.uniform(0, 1) * random.unit_vector();
      const double expected = winding_by_solid_angle(mesh, point);
      if (std::abs(expected - std::round(expected)) > 0.01) continue;  // nearly on the surface
      const Winding winding = winding_number(mesh, point);
      ASSERT_EQ(winding.number, std::lround(expected)) << i;
      inside += winding.number != 0 ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 1000);
}

TEST(Winding, AMeshInsideAnotherIsFound) {
  const Mesh<double> large = cube_mesh(3), small = cube_mesh(1);
  const Pose<double> within{Quatd::Identity(), Vec3d(0.5, -0.5, 0.25)};
  const Pose<double> elsewhere{Quatd::Identity(), Vec3d(7, 0, 0)};
  EXPECT_EQ(mesh_containment(large, small, within), Containment::BInA);
  EXPECT_EQ(mesh_containment(small, large, within), Containment::AInB);
  EXPECT_EQ(mesh_containment(large, small, elsewhere), Containment::Separation);
  EXPECT_EQ(
      mesh_containment(mesh_cast<float>(large), mesh_cast<float>(small), within.cast<float>()),
      Containment::BInA);
}

TEST(Winding, OnePartAmongManyIsFound) {
  // Two cubes in one mesh; the second one is inside.
  Mesh<double> one = cube_mesh(1);
  std::vector<Vec3d> vertices;
  std::vector<std::array<int, 3>> triangles = one.triangles;
  for (const Vec3d& vertex : one.vertices) vertices.push_back(vertex + Vec3d(20, 0, 0));
  for (const Vec3d& vertex : one.vertices) vertices.push_back(vertex);
  for (const std::array<int, 3>& t : one.triangles)
    triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  EXPECT_EQ(mesh_containment(cube_mesh(3), build_mesh(vertices, triangles), Pose<double>{}),
            Containment::BInA);
}

TEST(Winding, HolesAreReported) {
  const Mesh<double> cube = cube_mesh(1);
  EXPECT_TRUE(open_edges(cube).empty());
  std::vector<std::array<int, 3>> triangles = cube.triangles;
  triangles.pop_back();
  const Mesh<double> open = build_mesh(cube.vertices, triangles);
  EXPECT_EQ(open_edges(open).size(), 3u);
  EXPECT_EQ(mesh_containment(open, cube, Pose<double>{}), Containment::AHasHoles);
  EXPECT_EQ(mesh_containment(cube, open, Pose<double>{}), Containment::BHasHoles);
}

}  // namespace
}  // namespace contactscope
