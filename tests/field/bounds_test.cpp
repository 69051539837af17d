#include <gtest/gtest.h>

#include "field/distance_field.h"
#include "support/random_geometry.h"
#include "support/sphere_mesh.h"
#include "support/surface_oracle.h"

namespace contactscope {
namespace {

using test::Random;

TEST(FieldBounds, SlowAreNeverWrongInAMillionQueries) {
  // exact() is compared with exhaustion elsewhere; here it judges the bounds from nodes.
  Random random(9);
  for (const int band : {0, 1, 3}) {
    for (const double waves : {0.0, 0.1, 0.4}) {
      const double size = random.decade(-4, 4);
      const PlacedField field =
          build_distance_field(test::built(test::sphere_mesh(size, 16, 11, waves)),
                               {.cells = 24, .band = band, .exact = false});
      double widest = 0;
      for (int k = 0; k < 112000; ++k) {
        const Vec3d p = random.vector(-1.7 * size, 1.7 * size);
        const FieldBounds bounds = field.bounds(p);
        const double truth = field.exact(p).distance;
        ASSERT_LE(bounds.lower, truth);
        ASSERT_GE(bounds.upper, truth);
        if (field.field->in_band(field.in_lattice(p)))
          widest = std::max(widest, bounds.upper - bounds.lower);
      }
      // No point of a cell is farther than half its diagonal from a node.
      EXPECT_LE(widest, 1.7321 * field.cell);
    }
  }
}

TEST(FieldBounds, NodeBoundsAreWithinRounding) {
  // Fine nodes are within the band and the diagonal of a block of the surface, 2^15 steps.
  Random random(19);
  const double size = random.decade(-4, 4);
  const PlacedField field = build_distance_field(test::built(test::sphere_mesh(size, 16, 11, 0.1)),
                                                 {.cells = 40, .exact = false});
  int fine = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3d node = (field.field->size().cwiseProduct(random.vector(0, 1))).array().floor();
    if (!field.field->in_band(node)) continue;
    ++fine;
    const FieldBounds bounds = field.field->bounds(node);
    const double truth = field.field->exact(node).distance;
    ASSERT_LE(bounds.lower, truth);
    ASSERT_GE(bounds.upper, truth);
    ASSERT_LE(bounds.upper - bounds.lower, 1.03 * (3 + 4 * 1.7321) / 32767);
  }
  EXPECT_GT(fine, 2000);
}

TEST(FieldBounds, SlowHoldThousandsOfCellsFromTheCornerOfTheLattice) {
  // There, float resolves a place only to 2^-12 of a cell.
  const test::SphereMesh ball = test::sphere_mesh(0.5, 16, 11, 0.2);
  std::vector<Vec3d> vertices = ball.vertices;
  std::vector<std::array<int, 3>> triangles = ball.triangles;
  const int first = count_of(vertices);
  const double offset = 200;
  for (const Vec3d& vertex : ball.vertices) vertices.emplace_back(vertex + offset * Vec3d::UnitX());
  for (const auto& [a, b, c] : ball.triangles)
    triangles.push_back({first + a, first + b, first + c});
  const Mesh<double> mesh = build_mesh(vertices, triangles);
  const test::SurfaceOracle oracle(mesh.vertices, mesh.triangles);
  for (const auto interpolation : {FieldInterpolation::Trilinear, FieldInterpolation::Cubic}) {
    const PlacedField field =
        build_distance_field(mesh, {.cells = 4000, .interpolation = interpolation});
    Random random(18);
    for (int k = 0; k < 500; ++k) {
      const Vec3d p = offset * Vec3d::UnitX() + random.vector(-0.8, 0.8);
      const auto truth = static_cast<double>(oracle.signed_distance(p));
      const FieldBounds bounds = field.bounds(p);
      ASSERT_LE(bounds.lower, truth + 1e-13 * offset);
      ASSERT_GE(bounds.upper, truth - 1e-13 * offset);
      ASSERT_NEAR(field.exact(p).distance, truth, 1e-13 * offset);
      const bool fine = field.field->in_band(field.in_lattice(p));
      ASSERT_NEAR(field.sample(p).distance, truth, (fine ? 0.33 : 1.3) * field.cell);
    }
  }
}

TEST(FieldBounds, AreAsNarrowAsRoundingWhereTheSurfaceIs) {
  const PlacedField field =
      build_distance_field(test::built(test::sphere_mesh(1, 16, 11, 0.1)), {.cells = 24});
  Random random(10);
  int narrow = 0;
  for (int k = 0; k < 5000; ++k) {
    const Vec3d p = random.vector(-1, 1);
    const FieldBounds bounds = field.bounds(p);
    ASSERT_LE(bounds.lower, bounds.upper);
    if (!field.field->at_surface(field.in_lattice(p))) continue;
    ++narrow;
    ASSERT_LE(bounds.upper - bounds.lower, 1e-9 * field.cell);
  }
  EXPECT_GT(narrow, 200);
}

}  // namespace
}  // namespace contactscope
