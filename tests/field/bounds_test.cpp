#include <gtest/gtest.h>

#include "field/distance_field.h"
#include "support/random_geometry.h"
#include "support/sphere_mesh.h"

namespace contactscope {
namespace {

using test::Random;

TEST(FieldBounds, SlowAreNeverWrongInAMillionQueries) {
  // exact() is held against exhaustion elsewhere; here it judges what nodes say.
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

TEST(FieldBounds, AreAsNarrowAsRoundingWhereTheSurfaceIs) {
  const PlacedField field =
      build_distance_field(test::built(test::sphere_mesh(1, 16, 11, 0.1)), {.cells = 24});
  Random random(10);
  int narrow = 0;
  for (int k = 0; k < 5000; ++k) {
    const Vec3d p = random.vector(-1, 1);
    const FieldBounds bounds = field.bounds(p);
    ASSERT_LE(bounds.lower, bounds.upper);
    if (field.sample(p).source != FieldSample::Source::Exact) continue;
    ++narrow;
    ASSERT_LE(bounds.upper - bounds.lower, 1e-9 * field.cell);
  }
  EXPECT_GT(narrow, 200);
}

}  // namespace
}  // namespace contactscope
