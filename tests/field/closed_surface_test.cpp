#include "field/closed_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/input_error.h"
#include "field/distance_field.h"
#include "query/winding.h"
#include "support/random_geometry.h"
#include "support/sphere_mesh.h"
#include "support/surface_oracle.h"

namespace contactscope {
namespace {

using test::Random;

TEST(ClosedSurface, LeavesAWatertightMeshAsItIs) {
  const Mesh<double> cube = test::cube_mesh(1);
  const ClosedSurface closed = close_surface(cube);
  EXPECT_EQ(closed.mesh.triangle_count(), 12);
  EXPECT_EQ(closed.own_triangles, 12);
  EXPECT_EQ(closed.cap_share, 0);
}

TEST(ClosedSurface, SmallHolesLeaveTheInsideWhereSolidAnglesFindIt) {
  Random random(6);
  for (int i = 0; i < 8; ++i) {
    const double size = random.decade(-4, 4);
    test::SphereMesh sphere = test::sphere_mesh(size, 16, 11, 0.2);
    std::vector<Vec3d> lost;
    for (int k = 0; k < 6; ++k) {
      const int hole = random.index(count_of(sphere.triangles));
      lost.push_back(at(sphere.vertices, at(sphere.triangles, hole)[0]));
      sphere.triangles.erase(sphere.triangles.begin() + hole);
    }
    const Mesh<double> mesh = test::built(sphere);
    ASSERT_FALSE(open_edges(mesh).empty());
    const ClosedSurface closed = close_surface(mesh);
    EXPECT_GT(closed.cap_share, 0);
    const test::SurfaceOracle open(sphere.vertices, sphere.triangles);
    const test::SurfaceOracle whole(closed.mesh.vertices, closed.mesh.triangles);
    const PlacedField field = build_distance_field(mesh, {.cells = 20});
    for (int k = 0; k < 100; ++k) {
      const Vec3d p = random.vector(-1.3 * size, 1.3 * size);
      const auto winding = static_cast<double>(whole.winding(p));
      ASSERT_NEAR(winding, std::round(winding), 1e-9);
      ASSERT_NEAR(field.exact(p).distance, static_cast<double>(whole.signed_distance(p)),
                  1e-12 * size);
      // Near a hole, both methods of closing it are equally good.
      if (std::ranges::any_of(lost, [&](const Vec3d& v) { return (v - p).norm() < 0.7 * size; }))
        continue;
      EXPECT_EQ(field.exact(p).distance < 0, open.signed_distance(p) < 0) << i;
    }
  }
}

TEST(ClosedSurface, ATriangleThatIsTurnedOverIsTurnedBack) {
  test::SphereMesh sphere = test::sphere_mesh(1, 12, 7, 0);
  const test::SurfaceOracle oracle(sphere.vertices, sphere.triangles);
  std::swap(sphere.triangles[40][0], sphere.triangles[40][1]);
  const PlacedField field = build_distance_field(test::built(sphere), {.cells = 16});
  Random random(7);
  for (int k = 0; k < 2000; ++k) {
    const Vec3d p = random.vector(-1.2, 1.2);
    ASSERT_NEAR(field.exact(p).distance, static_cast<double>(oracle.signed_distance(p)), 1e-13);
  }
}

TEST(ClosedSurface, ABoxWithoutALidHasAnInsideAndASheetHasNone) {
  Mesh<double> cube = test::cube_mesh(0.5);
  std::vector<std::array<int, 3>> without_lid;
  for (int t = 0; t < cube.triangle_count(); ++t)
    if (cube.normal(t).y() < 0.5) without_lid.push_back(at(cube.triangles, t));
  ASSERT_EQ(without_lid.size(), 10U);
  const PlacedField field =
      build_distance_field(build_mesh(cube.vertices, without_lid), {.cells = 16});
  EXPECT_NEAR(field.exact(Vec3d::Zero()).distance, -0.5, 1e-14);
  EXPECT_NEAR(field.exact(Vec3d(0, 0.7, 0)).distance, 0.2, 1e-14);

  const auto refused = [&](const Mesh<double>& mesh) {
    try {
      close_surface(mesh);
    } catch (const ShapeError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const Mesh<double> sheet =
      build_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  EXPECT_NE(refused(sheet).find("has no inside"), std::string::npos);
  // Both sides of a sheet: closed, but around nothing.
  const Mesh<double> folded = build_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
  EXPECT_NE(refused(folded).find("has no inside"), std::string::npos);
}

TEST(ClosedSurface, PartsInsideOutAreInsideToo) {
  // Two balls, one with its fronts inside.
  test::SphereMesh both = test::sphere_mesh(0.5, 12, 7, 0);
  const int first = count_of(both.vertices);
  const test::SphereMesh other = test::sphere_mesh(0.4, 12, 7, 0);
  for (const Vec3d& vertex : other.vertices)
    both.vertices.emplace_back(vertex + 2 * Vec3d::UnitX());
  for (const auto& [a, b, c] : other.triangles)
    both.triangles.push_back({first + b, first + a, first + c});
  const test::SurfaceOracle oracle(both.vertices, both.triangles);
  const PlacedField field = build_distance_field(test::built(both), {.cells = 24});
  Random random(8);
  for (int k = 0; k < 3000; ++k) {
    const Vec3d p(random.uniform(-0.6, 2.6), random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6));
    const auto truth = static_cast<double>(oracle.signed_distance(p));
    ASSERT_NEAR(field.exact(p).distance, truth, 1e-13) << p.transpose();
    ASSERT_LE(field.bounds(p).lower, truth);
    ASSERT_GE(field.bounds(p).upper, truth);
  }
}

}  // namespace
}  // namespace contactscope
