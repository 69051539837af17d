#include "field/triangle_sieve.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random_geometry.h"
#include "support/sphere_mesh.h"
#include "support/surface_oracle.h"

namespace contactscope {
namespace {

using test::Random;

struct Surface {
  std::shared_ptr<const Mesh<double>> mesh;
  double size;  // the largest coordinate
};

/// A wavy ball, or slivers of any size, from 0 to `size` along each axis.
Surface random_surface(Random& random, int number) {
  const double size = random.decade(1, 3.6);
  std::vector<Vec3d> vertices;
  std::vector<std::array<int, 3>> triangles;
  if (number % 2 == 0) {
    test::SphereMesh sphere = test::sphere_mesh(0.4 * size, 24, 15, 0.2);
    vertices = std::move(sphere.vertices);
    for (Vec3d& vertex : vertices) vertex += Vec3d::Constant(0.5 * size);
    triangles = std::move(sphere.triangles);
  } else {
    for (int t = 0; t < 200; ++t) {
      const Vec3d from = random.vector(0.1 * size, 0.9 * size);
      const double length = 0.1 * size * random.decade(-3, 0);
      const Vec3d along = length * random.unit_vector();
      const Vec3d foot = from + random.uniform(0, 1) * along;
      const double height = length * random.decade(-4, 0);
      vertices.insert(vertices.end(),
                      {from, Vec3d(from + along), Vec3d(foot + height * random.unit_vector())});
      triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
  }
  return {std::make_shared<const Mesh<double>>(build_mesh(vertices, triangles)), size};
}

Vec3d on_eighths(const Vec3d& point) { return (8 * point).array().round().matrix() / 8; }

TEST(TriangleSieve, SlowLosesNoTriangleThatIsNearestToAPointOfACube) {
  Random random(23);
  for (int i = 0; i < 40; ++i) {
    const Surface surface = random_surface(random, i);
    const NearestTriangles triangles(surface.mesh);
    const TriangleSieve sieve(triangles, surface.size);
    const test::SurfaceOracle oracle(surface.mesh->vertices, surface.mesh->triangles);
    for (int k = 0; k < 30; ++k) {
      TriangleSieve::List of_cube, of_part;
      const Vec3d middle = on_eighths(random.vector(0, surface.size));
      // Half of the time, start from a point of the surface that is not the nearest one.
      const Vec3d aside = k % 2 == 0 ? Vec3d::Zero().eval() : random.vector(-1, 1);
      sieve.fill_around(middle, 2, triangles.nearest(middle + aside).point, of_cube);
      const Vec3d half = middle + Vec3d(1, -1, 1);
      const NearestPoint of_half = triangles.nearest(half + aside);
      sieve.fill_within(of_cube, half, 1, of_half.point, of_part);
      const Vec3d quarter = half + Vec3d(-0.5, 0.5, 0.5);
      const NearestPoint of_quarter = triangles.nearest(quarter + aside);
      std::vector<int> of_cell;
      sieve.append(of_part, quarter, 0.5, of_quarter.point, of_cell);
      const auto expect_nearest = [&](const std::span<const int> among, const Vec3d& point) {
        const auto truth = static_cast<double>(oracle.distance(point));
        ASSERT_NEAR(std::sqrt(triangles.nearest_of(among, point).squared), truth,
                    1e-13 * surface.size);
      };
      for (int n = 0; n < 10; ++n) {
        expect_nearest(of_cube.triangles(), middle + random.vector(-2, 2));
        expect_nearest(of_part.triangles(), half + random.vector(-1, 1));
        expect_nearest(of_cell, quarter + random.vector(-0.5, 0.5));
      }
      // For points that are exact in float, the nearest triangle itself.
      const Vec3d point = middle + Vec3d(1.5, -2, 0.125);
      ASSERT_NEAR(std::sqrt(sieve.nearest(of_cube, point).squared),
                  static_cast<double>(oracle.distance(point)), 1e-13 * surface.size);
      const int seed = (7 * k + i) % surface.mesh->triangle_count();
      ASSERT_NEAR(std::sqrt(sieve.nearest(point, seed).squared),
                  static_cast<double>(oracle.distance(point)), 1e-13 * surface.size);
      ASSERT_NEAR(std::abs(sieve.rough_distance(of_cube, point)),
                  static_cast<double>(oracle.distance(point)),
                  TriangleSieve::kRoughness * surface.size);
    }
  }
}

TEST(TriangleSieve, LeavesADiscOfAFlatSurface) {
  // A square of 64 x 64 cells, two triangles a cell.
  std::vector<Vec3d> vertices;
  std::vector<std::array<int, 3>> squares;
  constexpr int kCount = 64;
  for (int j = 0; j <= kCount; ++j)
    for (int i = 0; i <= kCount; ++i) vertices.emplace_back(i, j, 4);
  for (int j = 0; j < kCount; ++j) {
    for (int i = 0; i < kCount; ++i) {
      const int a = j * (kCount + 1) + i, b = a + kCount + 1;
      squares.insert(squares.end(), {{a, a + 1, b + 1}, {a, b + 1, b}});
    }
  }
  const NearestTriangles triangles(
      std::make_shared<const Mesh<double>>(build_mesh(vertices, squares)));
  const TriangleSieve sieve(triangles, kCount);
  for (const double height : {0.5, 3.0, 12.0}) {
    const Vec3d middle(32.5, 31.5, 4 + height);
    TriangleSieve::List of_cube, of_cell;
    sieve.fill_around(middle, 0.5, triangles.nearest(middle).point, of_cube);
    const NearestPoint nearest = sieve.nearest(of_cube, middle);
    sieve.fill_within(of_cube, middle, 0.5, nearest.point, of_cell);
    EXPECT_GE(of_cell.triangles().size(), 2U);
    EXPECT_LE(of_cell.triangles().size(), 20U) << height;
  }
}

}  // namespace
}  // namespace contactscope
