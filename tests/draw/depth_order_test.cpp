#include "draw/scene/visibility.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace contactscope::draw {
namespace {

const Rect kViewport{0, 0, 400, 400};

Camera from_front() {
  return Camera::perspective({0, 0, 10}, {0, 0, 0}, Vec3d::UnitY(), 0.6, kViewport);
}

// A square of half width 1 facing the camera at depth z; the red channel names it.
Surface square(double z, float name) {
  return {{{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}}, {name, 0, 0, 1}};
}

std::vector<float> names(const std::vector<Surface>& surfaces) {
  std::vector<float> result;
  for (const Surface& surface : surfaces) result.push_back(surface.color.r);
  return result;
}

TEST(DepthOrder, ParallelSquaresArePaintedFarthestFirst) {
  EXPECT_THAT(names(depth_ordered({square(1, 1), square(-2, 2), square(0, 3)}, from_front())),
              testing::ElementsAre(2, 3, 1));
}

TEST(DepthOrder, CoplanarSurfacesKeepTheirOrder) {
  EXPECT_THAT(
      names(depth_ordered({square(0, 1), square(0, 2), square(0, 3), square(-1, 4)}, from_front())),
      testing::ElementsAre(4, 1, 2, 3));
}

TEST(DepthOrder, NothingWithoutAreaIsPainted) {
  Surface line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {}};
  EXPECT_TRUE(depth_ordered({line}, from_front()).empty());
  EXPECT_TRUE(depth_ordered({}, from_front()).empty());
}

// Distance along a ray from the eye through a point of the plane z = 0, for a convex polygon.
std::optional<double> hit(const Vec3d& eye, const Vec3d& direction,
                          const std::vector<Vec3d>& poly) {
  const Vec3d normal = (poly[1] - poly[0]).cross(poly[2] - poly[0]);
  const double slope = normal.dot(direction);
  if (std::abs(slope) < 1e-9 * normal.norm()) return std::nullopt;
  const double t = normal.dot(poly[0] - eye) / slope;
  const Vec3d p = eye + t * direction;
  for (std::size_t i = 0; i < poly.size(); ++i) {
    const Vec3d edge = poly[(i + 1) % poly.size()] - poly[i];
    if (normal.dot(edge.cross(p - poly[i])) < 1e-9) return std::nullopt;
  }
  return t;
}

TEST(DepthOrder, SlowRandomCrossingTrianglesAreOrderedAlongEveryRay) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-2, 2);
  for (int round = 0; round < 30; ++round) {
    std::vector<Surface> triangles;
    for (int i = 0; i < 12; ++i) {
      Surface triangle;
      for (int k = 0; k < 3; ++k) {
        triangle.polygon.emplace_back(any(random), any(random), any(random));
      }
      triangle.color.r = static_cast<float>(i);
      triangles.push_back(triangle);
    }
    const Camera camera = from_front();
    const std::vector<Surface> painted = depth_ordered(triangles, camera);
    for (int ray = 0; ray < 200; ++ray) {
      const Vec3d direction = (Vec3d(any(random), any(random), 0) - camera.eye()).normalized();
      double last = std::numeric_limits<double>::max();
      std::vector<float> crossed;
      for (const Surface& surface : painted) {
        const std::optional<double> t = hit(camera.eye(), direction, surface.polygon);
        if (!t) continue;
        EXPECT_LE(*t, last + 1e-4);
        last = *t;
        crossed.push_back(surface.color.r);
      }
      std::vector<float> expected;
      for (const Surface& surface : triangles) {
        std::vector<Vec3d> reversed(surface.polygon.rbegin(), surface.polygon.rend());
        if (hit(camera.eye(), direction, surface.polygon) ||
            hit(camera.eye(), direction, reversed)) {
          expected.push_back(surface.color.r);
        }
      }
      // Nothing lost or duplicated, except on rays that graze a cut.
      EXPECT_NEAR(static_cast<double>(crossed.size()), static_cast<double>(expected.size()), 1);
    }
  }
}

}  // namespace
}  // namespace contactscope::draw
