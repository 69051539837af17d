#include "geometry/primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace contactscope::test {
namespace {

TEST(Grid, IsCentredOnTheOriginWithItsSize) {
  const Mesh<double> grid = make_grid(10, 4, 50, 20, 0.25);
  const Aabb<double> bounds = grid.tree.bounds();
  EXPECT_EQ(bounds.lower.x(), -5);
  EXPECT_EQ(bounds.upper.x(), 5);
  EXPECT_EQ(bounds.lower.z(), -2);
  EXPECT_EQ(bounds.upper.z(), 2);
  EXPECT_EQ(grid.triangle_count(), 2 * 50 * 20);
  EXPECT_EQ(grid.vertices.size(), 51u * 21u);
}

TEST(Grid, FrontsAreUpEverywhere) {
  for (const double amplitude : {0.0, 0.3, -0.3}) {
    const Mesh<double> grid = make_grid(10, 10, 30, 40, amplitude);
    for (int t = 0; t < grid.triangle_count(); ++t) EXPECT_GT(grid.normal(t).y(), 0.5);
  }
}

TEST(Grid, WithoutAmplitudeIsExactlyFlat) {
  const Mesh<double> grid = make_grid(10, 10, 3, 5, 0);
  for (const Vec3d& vertex : grid.vertices) EXPECT_EQ(vertex.y(), 0);
  for (const Vec3d& normal : grid.normals) EXPECT_EQ(normal, Vec3d::UnitY());
}

TEST(Grid, SlowHasThreeWavesAlongEachSideAndItsHeight) {
  const Mesh<double> grid = make_grid(12, 24, 120, 240, 0.25);
  const auto height = [&](int i, int j) {
    return grid.vertices[static_cast<std::size_t>(i + 121 * j)].y();
  };
  EXPECT_NEAR(height(60 + 10, 120), 0.25, 1e-14);        // a quarter of a wave along x, 4 m long
  EXPECT_NEAR(height(60 + 30, 120), -0.25, 1e-14);       // three quarters
  EXPECT_NEAR(height(60 + 10, 120 + 40), -0.25, 1e-14);  // half a wave along z, 8 m long
  EXPECT_NEAR(height(60, 120), 0, 1e-14);
  for (const Vec3d& vertex : grid.vertices) EXPECT_LE(std::abs(vertex.y()), 0.25);
}

TEST(Grid, CellsCoverEachPlaceOnce) {
  const Mesh<double> grid = make_grid(3, 5, 4, 6, 0.2);
  double area = 0;  // seen from above
  for (int t = 0; t < grid.triangle_count(); ++t) {
    const Vec3d a = grid.corner(t, 1) - grid.corner(t, 0);
    const Vec3d b = grid.corner(t, 2) - grid.corner(t, 0);
    EXPECT_NEAR(a.z() * b.x() - a.x() * b.z(), 3.0 / 4 * 5 / 6, 1e-14);
    area += 0.5 * (a.z() * b.x() - a.x() * b.z());
  }
  EXPECT_NEAR(area, 15, 1e-13);
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 4; ++i) {
      Vec3d center = Vec3d::Zero();
      for (int k = 0; k < 3; ++k) {
        center += grid.corner(2 * (i + 4 * j), k) / 6 + grid.corner(2 * (i + 4 * j) + 1, k) / 6;
      }
      EXPECT_NEAR(center.x(), -1.5 + (i + 0.5) * 0.75, 1e-14);
      EXPECT_NEAR(center.z(), -2.5 + (j + 0.5) * 5 / 6, 1e-14);
    }
  }
}

TEST(Grid, BadSizesAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto refused = [](const std::function<void()>& make) {
    try {
      make();
    } catch (const ShapeError&) {
      return true;
    }
    return false;
  };
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    EXPECT_TRUE(refused([&] { make_grid(bad, 1, 1, 1, 0); }));
    EXPECT_TRUE(refused([&] { make_grid(1, bad, 1, 1, 0); }));
  }
  for (const int bad : {0, -1, std::numeric_limits<int>::min(), kMaxGridCells + 1}) {
    EXPECT_TRUE(refused([&] { make_grid(1, 1, bad, 1, 0); }));
    EXPECT_TRUE(refused([&] { make_grid(1, 1, 1, bad, 0); }));
  }
  EXPECT_TRUE(refused([] { make_grid(1, 1, 65536, 65536, 0); }));
  EXPECT_TRUE(refused([&] { make_grid(1, 1, 1, 1, nan); }));
  EXPECT_FALSE(refused([] { make_grid(1, 1, 1, 1, 0); }));
}

}  // namespace
}  // namespace contactscope::test
