#include "lint/solid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace contactscope::lint {
namespace {

trace::Shape box(const Vec3d& half) {
  trace::Shape shape;
  shape.name = "box";
  shape.type = "box";
  for (int i = 0; i < 8; ++i)
    shape.vertices.emplace_back((i & 1 ? 1 : -1) * half.x(), (i & 2 ? 1 : -1) * half.y(),
                                (i & 4 ? 1 : -1) * half.z());
  return shape;
}

trace::Shape capsule(const Vec3d& from, const Vec3d& to, double radius) {
  trace::Shape shape;
  shape.type = "capsule";
  shape.vertices = {from, to};
  shape.radius = radius;
  return shape;
}

TEST(Solid, DistanceOfABoxIsThatOfItsFacesEdgesAndVertices) {
  const Solid solid(box({1, 2, 3}));
  EXPECT_NEAR(solid.distance({0, 0, 0}), -1, 1e-14);
  EXPECT_NEAR(solid.distance({1.5, 0, 0}), 0.5, 1e-14);
  EXPECT_NEAR(solid.distance({4, 6, 0}), 5, 1e-13);  // an edge
  EXPECT_NEAR(solid.distance({3, 5, 9}), 7, 1e-13);  // a vertex: 2, 3, 6
  EXPECT_NEAR(*solid.exit({0, 0, 0}, {0, 1, 0}), 2, 1e-14);
  EXPECT_NEAR(*solid.exit({0, 5, 0}, {0, 1, 0}), -3, 1e-14);  // it is behind
  EXPECT_NEAR(solid.size(), std::sqrt(14.0), 1e-14);
}

/// The exit of a capsule is found by small steps along the direction.
TEST(Solid, ACapsuleIsLeftWhereItsSurfaceIs) {
  std::mt19937_64 engine(3);
  int requested = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto point = [&] {
      const double x = uniform(engine, -1, 1), y = uniform(engine, -1, 1);
      return Vec3d(x, y, uniform(engine, -1, 1));
    };
    const Vec3d one_end = point(), other_end = point();
    const Solid solid(capsule(one_end, other_end, 0.6));
    const Vec3d from = point(), direction = point().normalized();
    if (solid.distance(from) > 0) continue;
    ++requested;
    double inside = 0, outside = 8;
    while (outside - inside > 1e-12) {
      const double middle = (inside + outside) / 2;
      (solid.distance(from + middle * direction) < 0 ? inside : outside) = middle;
    }
    EXPECT_NEAR(*solid.exit(from, direction), outside, 1e-9);
  }
  EXPECT_GT(requested, 100);
}

TEST(Solid, BestSeparationOfBoxesIsAlongTheNearestFaces) {
  const Solid one(box({1, 1, 1})), other(box({0.5, 0.5, 0.5}));
  Placed a{&one}, b{&other};
  b.pose.position = {0.3, 1.4, 0};
  EXPECT_NEAR(best_separation(a, b)->distance, -0.1, 1e-12);
  EXPECT_LT((best_separation(a, b)->normal - Vec3d::UnitY()).norm(), 1e-9);
  b.pose.position = {4.5, 5.5, 0};  // offset by 3 and 4
  EXPECT_NEAR(best_separation(a, b)->distance, 5, 1e-12);
  EXPECT_NEAR(separation_along(a, b, {0, 1, 0}), 4, 1e-12);
}

TEST(Solid, AMeshIsLeftThroughTheNearestTriangle) {
  trace::Shape shape = box({1, 1, 1});
  shape.type = "mesh";
  shape.faces = {{4, 5, 7, 6}, {1, 0, 2, 3}};  // its two sides across z
  const Solid solid(shape);
  EXPECT_NEAR(solid.distance({0, 0, 1.5}), 0.5, 1e-12);
  EXPECT_NEAR(*solid.exit({0.2, 0.3, 0.9}, {0, 0, 1}), 0.1, 1e-12);
  EXPECT_NEAR(*solid.exit({0.2, 0.3, -0.9}, {0, 0, 1}), -0.1, 1e-12);
}

}  // namespace
}  // namespace contactscope::lint
