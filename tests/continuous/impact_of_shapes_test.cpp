#include "continuous/impact_of_shapes.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "continuous/impact_with_mesh.h"
#include "field/closed_surface.h"
#include "field/distance_field.h"
#include "geometry/hull_builder.h"
#include "geometry/primitives.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Random;

constexpr std::array<ImpactMethod, 2> kImpactMethods = {ImpactMethod::ConservativeAdvancement,
                                                        ImpactMethod::TimeOfImpact};

/// Triangles scattered about a ball of `size` metres.
Mesh<double> random_mesh(Random& random, double size) {
  std::vector<Vec3d> vertices;
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < 60; ++i) {
    const Vec3d place = size * random.uniform(0.5, 1) * random.unit_vector();
    for (int k = 0; k < 3; ++k) vertices.emplace_back(place + 0.3 * size * random.vector(-1, 1));
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return build_mesh(vertices, triangles);
}

Shape<double> random_convex(Random& random, double size) {
  switch (random.index(3)) {
    case 0:
      return Sphere<double>{0.3 * size};
    case 1: {
      const Vec3d half = 0.4 * size * random.unit_vector();
      return Capsule<double>{{-half, half}, 0.1 * size};
    }
    default:
      return test::random_hull(random, 12, size, 3);
  }
}

Sweep<double> random_motion(Random& random, double size, bool turns) {
  Sweep<double> motion;
  motion.start = random.pose(size);
  motion.displacement = size * random.vector(-1, 1);
  motion.pivot = 0.2 * size * random.vector(-1, 1);
  if (turns) {
    const double angle = random.uniform(0, 3);
    motion.turn = angle * random.unit_vector();
  }
  return motion;
}

/// Each triangle as a flat hull.
std::vector<Shape<double>> triangles_of(const Mesh<double>& mesh) {
  std::vector<Shape<double>> hulls;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    hulls.push_back(build_hull(corners_of(mesh, t), {.allow_flat = true}));
  return hulls;
}

/// A mesh is hit at the time of its first triangle, each tested alone as a flat hull.
template <class S> void meshes_are_met_as_their_triangles_are() {
  Random random(21);
  int hits = 0, separation = 0, few = 0;
  for (int i = 0; i < 150; ++i) {
    const double size = random.decade(-2, 2);
    const Mesh<double> mesh = random_mesh(random, size);
    const Shape<double> convex = random_convex(random, size);
    Sweep<double> of_mesh = random_motion(random, size, random.chance(0.5));
    Sweep<double> of_convex = random_motion(random, size, random.chance(0.5));
    of_convex.start.position += 4 * size * random.unit_vector();
    const Vec3d aim = 1.5 * size * random.vector(-1, 1);
    of_convex.displacement += random.uniform(0.5, 2) * (aim - of_convex.start.position);

    const Shape<S> a = shape_cast<S>(Shape<double>(mesh)), b = shape_cast<S>(convex);
    const Sweep<S> motion_a = of_mesh.cast<S>(), motion_b = of_convex.cast<S>();
    for (const ImpactMethod method : kImpactMethods) {
      const ShapeImpact<S> found = impact_of_shapes(a, motion_a, b, motion_b, method);
      double first = 2;
      for (const Shape<double>& hull : triangles_of(mesh)) {
        const Shape<S> triangle = shape_cast<S>(hull);
        const ShapeImpact<S> one = impact_of_shapes(triangle, motion_a, b, motion_b, method);
        if (one.result.status == ImpactStatus::Hit)
          first = std::min(first, static_cast<double>(one.result.time));
        ASSERT_NE(one.result.status, ImpactStatus::OutOfIterations);
      }
      // The same from the other side.
      const ShapeImpact<S> other = impact_of_shapes(b, motion_b, a, motion_a, method);
      EXPECT_EQ(other.result.time, found.result.time);
      EXPECT_EQ(other.triangle, found.triangle);
      EXPECT_EQ(other.result.normal, Vec3<S>(-found.result.normal));
      if (first > 1) {
        EXPECT_EQ(found.result.status, ImpactStatus::Separated) << i;
        ++separation;
        continue;
      }
      ++hits;
      ASSERT_EQ(found.result.status, ImpactStatus::Hit) << i;
      // A ball's time is exact, and the triangle's is early by the tolerance.
      EXPECT_NEAR(static_cast<double>(found.result.time), first, 2e-3) << i;
      EXPECT_GE(static_cast<double>(found.result.time), first - 1e-5) << i;
      few += found.triangles < mesh.triangle_count() / 2;
    }
  }
  EXPECT_GT(hits, 60);
  EXPECT_GT(separation, 30);
  EXPECT_GT(few, hits / 4);
}

TEST(ImpactOfShapes, SlowMeshesAreMetAsTheirTrianglesAre) {
  meshes_are_met_as_their_triangles_are<double>();
  meshes_are_met_as_their_triangles_are<float>();
}

/// A body that flies at a wall of 1 cm or of a triangle's thickness does not pass it, at any speed,
/// spin or place; the wall may move towards it.
TEST(ImpactOfShapes, SlowNothingTunnels) {
  Random random(22);
  const Shape<float> plate = shape_cast<float>(Shape<double>(make_box(Vec3d(0.005, 3, 3))));
  const std::vector<Vec3d> corners = {Vec3d(0, -3, -3), Vec3d(0, 3, -3), Vec3d(0, 3, 3),
                                      Vec3d(0, -3, 3)};
  const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  const Shape<float> sheet = shape_cast<float>(Shape<double>(build_mesh(corners, triangles)));
  const Shape<float> ball = Sphere<float>{0.05f};
  const Shape<float> box = shape_cast<float>(Shape<double>(make_box(Vec3d(0.05, 0.04, 0.03))));
  const Shape<float> rod =
      Capsule<float>{{Vec3<float>(-0.3f, 0, 0), Vec3<float>(0.3f, 0, 0)}, 0.01f};
  constexpr double kStep = 1.0 / 60;
  int through = 0, of = 0;
  for (const ImpactMethod method : kImpactMethods) {
    for (const double speed : {5.0, 20.0, 60.0, 200.0, 1000.0}) {
      for (int i = 0; i < 200; ++i) {
        const Shape<float>& bullet = i % 3 == 0 ? ball : i % 3 == 1 ? box : rod;
        const Shape<float>& wall = i % 2 == 0 ? plate : sheet;
        // It starts 0.4 m plus 10 to 90 % of its path before the wall, and passes near its middle.
        const double offset = speed * kStep;
        const double before = 0.4 + random.uniform(0.1, 0.9) * offset;
        Sweep<double> flies, stands;
        flies.start = random.pose(0);
        flies.start.position = Vec3d(-before, 0, 0) + random.level(0.5, 0.2);
        flies.start.position.x() = -before;
        flies.displacement = Vec3d(offset + 1.0, 0, 0);
        const double spin = random.uniform(0, 3 * std::numbers::pi);
        flies.turn = spin * random.unit_vector();
        if (i % 5 == 0) {  // the wall moves towards it
          stands.displacement = Vec3d(-0.5 * offset, 0, 0);
          flies.displacement.x() -= 0.5 * offset;
        }
        const ShapeImpact<float> found =
            impact_of_shapes(bullet, flies.cast<float>(), wall, stands.cast<float>(), method);
        ++of;
        through += found.result.status == ImpactStatus::Separated;
        EXPECT_NE(found.result.status, ImpactStatus::Overlapping);
      }
    }
  }
  EXPECT_EQ(of, 2000);
  EXPECT_EQ(through, 0);
}

/// Two meshes meet at the time of their first two triangles, each pair tested alone as flat hulls.
TEST(ImpactOfShapes, SlowTwoMeshesMeetAsTheirTrianglesDo) {
  Random random(23);
  int hits = 0, separation = 0, few = 0;
  for (int i = 0; i < 60; ++i) {
    const double size = random.decade(-4, 4);
    const Mesh<double> a = random_mesh(random, size), b = random_mesh(random, size);
    const Sweep<double> of_a = random_motion(random, size, random.chance(0.5));
    Sweep<double> of_b = random_motion(random, size, random.chance(0.5));
    of_b.start.position += 4 * size * random.unit_vector();
    const Vec3d aim = 2.5 * size * random.vector(-1, 1);
    of_b.displacement += random.uniform(0.5, 2) * (aim - of_b.start.position);
    const ShapeImpact<double> found =
        impact_of_shapes<double>(a, of_a, b, of_b, ImpactMethod::TimeOfImpact);
    double first = 2;
    const std::vector<Shape<double>> of_mesh_b = triangles_of(b);
    for (const Shape<double>& one : triangles_of(a)) {
      for (const Shape<double>& other : of_mesh_b) {
        const auto alone =
            impact_of_shapes(one, of_a, other, of_b, ImpactMethod::TimeOfImpact).result;
        ASSERT_TRUE(alone.status == ImpactStatus::Hit || alone.status == ImpactStatus::Separated);
        if (alone.status == ImpactStatus::Hit) first = std::min(first, alone.time);
      }
    }
    const ShapeImpact<double> turned =
        impact_of_shapes<double>(b, of_b, a, of_a, ImpactMethod::TimeOfImpact);
    EXPECT_EQ(turned.result.status, found.result.status) << i;
    EXPECT_NEAR(turned.result.time, found.result.time, 1e-4) << i;
    if (first > 1) {
      EXPECT_EQ(found.result.status, ImpactStatus::Separated) << i;
      ++separation;
      continue;
    }
    ++hits;
    ASSERT_EQ(found.result.status, ImpactStatus::Hit) << i;
    EXPECT_NEAR(found.result.time, first, 1e-4) << i;
    few += found.triangles < a.triangle_count() * b.triangle_count() / 4;
  }
  EXPECT_GT(hits, 25);
  EXPECT_GT(separation, 5);
  EXPECT_GT(few, hits / 5);
}

/// A box of triangles or the field of a box meets another one head-on: faces are flat on each other
/// at a known time. A field inside another overlaps it.
TEST(ImpactOfShapes, MeshesAndFieldsMeetHeadOn) {
  const Mesh<double> cube = surface_of(make_box(Vec3d(1, 1, 1)));
  const PlacedField placed = build_distance_field(Shape<double>(cube), {.cells = 16});
  const std::array<Shape<double>, 2> kinds = {cube, field_shape(placed, cube)};
  for (const Shape<double>& a : kinds) {
    for (const Shape<double>& b : kinds) {
      for (const ImpactMethod method : kImpactMethods) {
        Sweep<double> right, left;
        right.start.position = Vec3d(-3, 0.1, 0);
        right.displacement = Vec3d(3, 0, 0);
        left.start.position = Vec3d(3, 0, 0.2);
        left.displacement = Vec3d(-2, 0, 0);
        const auto found = impact_of_shapes(a, right, b, left, method).result;
        ASSERT_EQ(found.status, ImpactStatus::Hit);
        EXPECT_LE(found.time, 0.8);
        EXPECT_NEAR(found.time, 0.8, 1e-4);
        EXPECT_NEAR(found.normal.x(), 1, 1e-6);
      }
    }
  }
  const Mesh<double> small = surface_of(make_box(Vec3d(0.2, 0.2, 0.2)));
  Sweep<double> stands, goes;
  goes.displacement = Vec3d(0.1, 0, 0);
  const auto inside =
      impact_of_shapes<double>(kinds[1], stands, small, goes, ImpactMethod::TimeOfImpact).result;
  EXPECT_EQ(inside.status, ImpactStatus::Overlapping);
  const auto hollow =
      impact_of_shapes<double>(cube, stands, small, goes, ImpactMethod::TimeOfImpact).result;
  EXPECT_EQ(hollow.status, ImpactStatus::Separated);  // a mesh is its triangles
}

TEST(ImpactOfShapes, APlaneIsMetByEveryOtherKind) {
  const Shape<double> plane = HalfSpace<double>{{Vec3d::UnitY(), 0.0}};
  const std::vector<Vec3d> corners = {Vec3d(0, -0.5, 0), Vec3d(1, 0.5, 0), Vec3d(0, 0.5, 1)};
  const std::vector<std::array<int, 3>> triangle = {{0, 1, 2}};
  const std::array<Shape<double>, 4> shapes = {
      Sphere<double>{0.5}, Capsule<double>{{Vec3d(0, -0.25, 0), Vec3d(0, 0.25, 0)}, 0.25},
      make_box(Vec3d(0.5, 0.5, 0.5)), build_mesh(corners, triangle)};
  Sweep<double> stands, falls;
  falls.start.position = Vec3d(3, 1.5, 0);
  falls.displacement = Vec3d(1, -2, 0);
  for (const Shape<double>& shape : shapes) {
    const auto found = impact_of_shapes(shape, falls, plane, stands, ImpactMethod::TimeOfImpact);
    ASSERT_EQ(found.result.status, ImpactStatus::Hit) << to_string(kind_of(shape));
    EXPECT_NEAR(found.result.time, 0.5, 1e-4);
    EXPECT_LE(found.result.time, 0.5);
    EXPECT_NEAR(found.result.normal.y(), -1, 1e-9);  // from the shape to the plane
    EXPECT_NEAR(found.result.on_b.y(), 0, 1e-9);
  }
  EXPECT_FALSE(impact_refusal(ShapeKind::Mesh, ShapeKind::Mesh));
  EXPECT_FALSE(impact_refusal(ShapeKind::Field, ShapeKind::Field));
  EXPECT_TRUE(impact_refusal(ShapeKind::Plane, ShapeKind::Plane));
  EXPECT_FALSE(impact_refusal(ShapeKind::Plane, ShapeKind::Mesh));
  EXPECT_FALSE(impact_refusal(ShapeKind::Mesh, ShapeKind::Capsule));
}

}  // namespace
}  // namespace contactscope
