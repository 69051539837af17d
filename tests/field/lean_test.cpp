#include "field/triangle_sieve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "field/nearest_point.h"
#include "support/random_geometry.h"
#include "support/sphere_mesh.h"

namespace contactscope {
namespace {

using test::Random;

/// A ball of radius 1 whose vertices are moved at random by up to `roughness` along each axis.
Mesh<double> rough_ball(Random& random, double roughness) {
  test::SphereMesh ball = test::sphere_mesh(1, 20, 13, 0.05);
  for (Vec3d& vertex : ball.vertices) vertex += random.vector(-roughness, roughness);
  return test::built(ball);
}

TEST(Lean, SlowNoNearestPointLeansMore) {
  Random random(31);
  long limited = 0, leaning = 0;
  for (int i = 0; i < 20; ++i) {
    const Mesh<double> mesh = rough_ball(random, random.decade(-4, -0.7));
    const std::vector<float> leans = largest_leans(mesh);
    const NearestTriangles triangles(std::make_shared<const Mesh<double>>(mesh));
    for (int k = 0; k < 3000; ++k) {
      const Vec3d point = random.vector(-1.6, 1.6);
      const NearestPoint nearest = triangles.nearest(point);
      // Each triangle that has a nearest point, if several are equally near.
      for (int t = 0; t < mesh.triangle_count(); ++t) {
        const float lean = at(leans, t);
        if (lean == kAnyLean) continue;
        const NearestPoint own = triangles.nearest_of({&t, 1}, point);
        if (own.squared > nearest.squared * (1 + 1e-13)) continue;
        const Vec3d offset = point - own.point;
        const double height = std::abs(offset.dot(mesh.normal(t)));
        const double across = offset.cross(mesh.normal(t)).norm();
        ASSERT_LE(across, height * double{lean} * (1 + 1e-6) + 1e-7);
        ++limited;
        leaning += across > 0.3 * height * double{lean} ? 1 : 0;
      }
    }
  }
  EXPECT_GT(limited, 30000);
  EXPECT_GT(leaning, limited / 100);
}

TEST(Lean, IsSmallWhereTrianglesAreASmoothSurfaceAndNoneOnAFlatOne) {
  std::vector<float> ball = largest_leans(test::built(test::sphere_mesh(1, 88, 55, 0)));
  std::ranges::sort(ball);
  EXPECT_LT(ball[ball.size() / 2], 0.15F);
  EXPECT_GT(ball.front(), 0.01F);
  // A tilted plane: only two of its triangles have neighbours around all corners.
  std::vector<Vec3d> vertices;
  std::vector<std::array<int, 3>> squares;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) vertices.emplace_back(i, j, 0.3 * i - 0.2 * j);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      squares.insert(squares.end(), {{4 * j + i, 4 * j + i + 1, 4 * j + i + 5},
                                     {4 * j + i, 4 * j + i + 5, 4 * j + i + 4}});
  const std::vector<float> flat = largest_leans(build_mesh(vertices, squares));
  for (int t = 0; t < count_of(flat); ++t) {
    const bool inner = t == 8 || t == 9;
    if (inner) {
      EXPECT_LT(at(flat, t), 1e-7F);
    } else {
      EXPECT_EQ(at(flat, t), kAnyLean);
    }
  }
}

TEST(Lean, KnowsNothingAtSharpEdges) {
  const Mesh<double> box = build_mesh(
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
      {{0, 2, 1},
       {0, 3, 2},
       {4, 5, 6},
       {4, 6, 7},
       {0, 1, 5},
       {0, 5, 4},
       {1, 2, 6},
       {1, 6, 5},
       {2, 3, 7},
       {2, 7, 6},
       {3, 0, 4},
       {3, 4, 7}});
  for (const float lean : largest_leans(box)) EXPECT_EQ(lean, kAnyLean);
}

}  // namespace
}  // namespace contactscope
