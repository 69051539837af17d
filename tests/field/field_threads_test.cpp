#include <gtest/gtest.h>

#include "field/distance_field.h"
#include "geometry/primitives.h"
#include "support/random_geometry.h"
#include "support/sphere_mesh.h"

namespace contactscope {
namespace {

using test::Random;

/// Equal in every bit at random points, some of them outside the lattice.
void expect_equal(const PlacedField& one, const PlacedField& other) {
  ASSERT_EQ(one.field->bytes(), other.field->bytes());
  ASSERT_EQ(one.field->fine_blocks(), other.field->fine_blocks());
  Random random(41);
  int fine = 0, at_surface = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3d point = one.field->size().cwiseProduct(random.vector(-0.1, 1.1));
    const FieldSample sample = one.field->sample(point), same = other.field->sample(point);
    ASSERT_EQ(sample.distance, same.distance);
    ASSERT_EQ(sample.gradient, same.gradient);
    ASSERT_EQ(sample.source, same.source);
    fine += sample.source == FieldSample::Source::Fine ? 1 : 0;
    at_surface += one.field->at_surface(point) ? 1 : 0;
    const FieldBounds bounds = one.field->bounds(point), same_bounds = other.field->bounds(point);
    ASSERT_EQ(bounds.lower, same_bounds.lower);
    ASSERT_EQ(bounds.upper, same_bounds.upper);
  }
  EXPECT_GT(fine, 500);
  EXPECT_GT(at_surface, 50);
}

TEST(FieldThreads, SlowAnyNumberBuildsTheSameField) {
  Random random(40);
  std::vector<std::pair<Shape<double>, int>> shapes;
  shapes.emplace_back(test::built(test::sphere_mesh(0.5, 60, 41, 0.1)), 80);  // over 16 layers
  shapes.emplace_back(make_box(Vec3d(0.5, 0.3, 0.2)), 40);
  shapes.emplace_back(Capsule<double>{{Vec3d(-1, 0, 0), Vec3d(1, 0.3, 0)}, 0.3}, 33);
  // Two intersecting balls, with noise.
  test::SphereMesh balls = test::sphere_mesh(0.4, 24, 15, 0.1);
  const int count = count_of(balls.vertices), triangles = count_of(balls.triangles);
  for (int i = 0; i < count; ++i)
    balls.vertices.emplace_back(at(balls.vertices, i) + Vec3d(0.3, 0.1, 0.2));
  for (Vec3d& vertex : balls.vertices) vertex += random.vector(-0.02, 0.02);
  for (int t = 0; t < triangles; ++t) {
    const auto [a, b, c] = at(balls.triangles, t);
    balls.triangles.push_back({a + count, b + count, c + count});
  }
  shapes.emplace_back(test::built(balls), 48);
  for (const auto& [shape, cells] : shapes) {
    FieldSettings settings{.cells = cells, .smooth = kSmoothPart, .threads = 1};
    const PlacedField one = build_distance_field(shape, settings);
    for (const int threads : {2, 3, 7, 0}) {
      settings.threads = threads;
      expect_equal(one, build_distance_field(shape, settings));
    }
  }
}

TEST(FieldThreads, CarryErrorsOver) {
  const FieldSettings settings{.cells = 200, .most_bytes = 1 << 20, .threads = 3};
  EXPECT_THROW(build_distance_field(make_box(Vec3d(0.5, 0.3, 0.2)), settings), ShapeError);
}

}  // namespace
}  // namespace contactscope
