#include "geometry/primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/hull_checks.h"

namespace contactscope::test {
namespace {

using std::numbers::pi;

TEST(MakeBox, HasExactNormalsInTheOrderOfTheAxes) {
  const Vec3d half(0.1, 0.7, 1e-3);
  const Hull<double> box = make_box(half);
  EXPECT_TRUE(is_sound(box));
  EXPECT_TRUE(is_convex(box, 0));
  ASSERT_EQ(box.face_count(), 6);
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t face = 2 * static_cast<std::size_t>(axis);
    EXPECT_EQ(box.planes[face].normal, Vec3d(Vec3d::Unit(axis)));
    EXPECT_EQ(box.planes[face + 1].normal, Vec3d(-Vec3d::Unit(axis)));
    EXPECT_EQ(box.planes[face].offset, half[axis]);
    EXPECT_EQ(box.planes[face + 1].offset, half[axis]);
  }
  EXPECT_EQ(box.centroid, Vec3d(0, 0, 0));
  EXPECT_DOUBLE_EQ(box.radius, half.norm());
}

TEST(MakeBox, VertexIndexSpellsTheSigns) {
  const Hull<double> box = make_box(Vec3d(1, 2, 3));
  EXPECT_EQ(box.vertices[0], Vec3d(-1, -2, -3));
  EXPECT_EQ(box.vertices[1], Vec3d(1, -2, -3));
  EXPECT_EQ(box.vertices[2], Vec3d(-1, 2, -3));
  EXPECT_EQ(box.vertices[4], Vec3d(-1, -2, 3));
  EXPECT_DOUBLE_EQ(measure(box).volume, 48);
}

TEST(MakeBox, AspectAMillionIsSoundAtAnyScale) {
  for (const double scale : {1e-4, 1.0, 1e4}) {
    const Hull<double> box = make_box(scale * Vec3d(1, 1e-6, 1));
    EXPECT_TRUE(is_sound(box));
    EXPECT_TRUE(is_convex(box, 0));
  }
}

TEST(MakeCylinder, IsAPrismOverARegularPolygon) {
  for (const int segments : {3, 4, 7, 24, 128}) {
    const Hull<double> cylinder = make_cylinder(0.5, 2, segments);
    EXPECT_TRUE(is_sound(cylinder)) << segments;
    EXPECT_TRUE(is_convex(cylinder, 1e-15)) << segments;
    EXPECT_EQ(cylinder.face_count(), segments + 2);
    EXPECT_EQ(cylinder.planes[0].normal, Vec3d(0, 1, 0));
    EXPECT_EQ(cylinder.planes[1].normal, Vec3d(0, -1, 0));
    const double polygon = 0.5 * segments * 0.25 * std::sin(2 * pi / segments);
    EXPECT_NEAR(measure(cylinder).volume, 4 * polygon, 1e-12);
    EXPECT_EQ(cylinder.centroid, Vec3d(0, 0, 0));
    for (const Vec3d& vertex : cylinder.vertices) {
      EXPECT_NEAR(std::hypot(vertex.x(), vertex.z()), 0.5, 1e-15);
      EXPECT_NEAR(vertex.norm(), cylinder.radius, 1e-15);
    }
    for (std::size_t side = 2; side < cylinder.planes.size(); ++side) {
      EXPECT_EQ(cylinder.planes[side].normal.y(), 0);
      EXPECT_NEAR(cylinder.planes[side].offset, 0.5 * std::cos(pi / segments), 1e-15);
    }
  }
}

TEST(MakeCylinder, CornersRunCounterClockwiseFromPlusX) {
  const Hull<double> cylinder = make_cylinder(2, 1, 8);
  const double diagonal = std::sqrt(2.0);
  const double expected[8][2] = {{2, 0},  {diagonal, -diagonal}, {0, -2}, {-diagonal, -diagonal},
                                 {-2, 0}, {-diagonal, diagonal}, {0, 2},  {diagonal, diagonal}};
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_DOUBLE_EQ(cylinder.vertices[2 * k].x(), expected[k][0]);
    EXPECT_DOUBLE_EQ(cylinder.vertices[2 * k].z(), expected[k][1]);
    EXPECT_EQ(cylinder.vertices[2 * k].y(), -1);
    EXPECT_EQ(cylinder.vertices[2 * k + 1].y(), 1);
  }
}

TEST(MakeCylinder, MirrorsItselfToTheLastBit) {
  const int segments = 24;
  const Hull<double> cylinder = make_cylinder(0.37, 1, segments);
  for (std::size_t k = 1; k < segments; ++k) {
    const Vec3d& one = cylinder.vertices[2 * k];
    const Vec3d& mirrored = cylinder.vertices[2 * (segments - k)];
    const Vec3d& opposite = cylinder.vertices[2 * ((k + segments / 2) % segments)];
    EXPECT_EQ(one.x(), mirrored.x());
    EXPECT_EQ(one.z(), -mirrored.z());
    EXPECT_EQ(one.x(), -opposite.x());
  }
}

TEST(MakeCone, IsAPyramidOverARegularPolygon) {
  for (const int segments : {3, 5, 16, 128}) {
    const Hull<double> cone = make_cone(0.5, 2, segments);
    EXPECT_TRUE(is_sound(cone)) << segments;
    EXPECT_TRUE(is_convex(cone, 1e-15)) << segments;
    EXPECT_EQ(cone.face_count(), segments + 1);
    EXPECT_EQ(cone.vertices.back(), Vec3d(0, 2, 0));
    EXPECT_EQ(cone.planes[0].normal, Vec3d(0, -1, 0));
    const double polygon = 0.5 * segments * 0.25 * std::sin(2 * pi / segments);
    EXPECT_NEAR(measure(cone).volume, 4 * polygon / 3, 1e-12);
    EXPECT_EQ(cone.centroid, Vec3d(0, -1, 0));
    EXPECT_EQ(cone.radius, 3);
  }
  EXPECT_NEAR(make_cone(10, 1, 5).radius, std::sqrt(100.25), 1e-12);
}

TEST(Primitives, RefuseSizesThatAreNoLengths) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    EXPECT_THROW(make_box(Vec3d(1, bad, 1)), ShapeError) << bad;
    EXPECT_THROW(make_cylinder(bad, 1, 8), ShapeError) << bad;
    EXPECT_THROW(make_cylinder(1, bad, 8), ShapeError) << bad;
    EXPECT_THROW(make_cone(bad, 1, 8), ShapeError) << bad;
    EXPECT_THROW(make_cone(1, bad, 8), ShapeError) << bad;
  }
  for (const int bad : {-1, 0, 2, 129}) {
    EXPECT_THROW(make_cylinder(1, 1, bad), ShapeError) << bad;
    EXPECT_THROW(make_cone(1, 1, bad), ShapeError) << bad;
  }
}

}  // namespace
}  // namespace contactscope::test
