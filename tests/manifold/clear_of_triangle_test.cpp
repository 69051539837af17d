#include "manifold/fast/clear_of_triangle.h"

#include <gtest/gtest.h>

#include <string>

#include "geometry/primitives.h"
#include "geometry/triangle_hull.h"
#include "manifold/collide_pairs.h"
#include "manifold/dispatch.h"
#include "support/random_geometry.h"

// Triangles that a hull may skip do not touch it, and skipping them loses no contact.
namespace contactscope {
namespace {

using test::Random;

template <class S> struct HullOnGrid {
  Hull<S> hull;
  Mesh<S> grid;
  Pose<S> in_hull;
};

/// A box, or a hull with an even or odd number of vertices and faces; its origin may be outside.
Hull<double> draw_hull(double size, Random& random) {
  if (random.chance(0.4)) {
    Vec3d half;
    for (int k = 0; k < 3; ++k) half[k] = size * random.uniform(0.1, 0.6);
    return make_box(half);
  }
  const int vertices = 4 + random.index(random.chance(0.1) ? 90 : 13);
  const Hull<double> hull =
      test::random_hull(random, vertices, size * random.uniform(0.2, 0.6), random.decade(0, 1.5));
  if (random.chance(0.5)) return hull;
  return std::get<Hull<double>>(seen_from(hull, size * random.vector(-1, 1)));
}

template <class S> HullOnGrid<S> draw(Random& random) {
  const double size = random.chance(0.5) ? 1 : random.decade(-4, 4);
  const double amplitude = random.chance(0.3) ? 0 : size * random.uniform(0, 0.2);
  // Triangles may be thousands of times larger than the hull, too.
  const double side = 4 * size * (random.chance(0.8) ? 1 : random.decade(0, 4));
  const Shape<double> grid = make_grid(side, side, 8, 8, amplitude);
  Pose<double> in_hull;
  if (random.chance(0.7)) in_hull.rotation = random.rotation();
  in_hull.position = size * random.vector(-1, 1);
  const Hull<S> hull = hull_cast<S>(draw_hull(size, random));
  return {hull, std::get<Mesh<S>>(shape_cast<S>(grid)), in_hull.cast<S>()};
}

template <class S> class ClearTriangles : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ClearTriangles, Scalars);

TYPED_TEST(ClearTriangles, AreSeparatedByTheSeparatingAxisTest) {
  using S = TypeParam;
  Random random(41);
  int clear = 0, gap = 0;
  for (int i = 0; i < 200; ++i) {
    const HullOnGrid<S> drawn = draw<S>(random);
    const S reach = drawn.hull.centroid.norm() + drawn.hull.radius + drawn.in_hull.position.norm();
    for (const double margin : {0.0, 0.05, 1.0}) {
      CollideOptions options;
      options.margin = margin * drawn.hull.radius;
      const ClearOfTriangle<S> is_clear(drawn.hull, drawn.grid, drawn.in_hull,
                                        static_cast<S>(options.margin), reach);
      for (int triangle = 0; triangle < drawn.grid.triangle_count(); ++triangle) {
        TriangleHull<S> flat;
        flat.set(drawn.grid, triangle);
        const Pose<S> placed{drawn.in_hull.rotation, drawn.in_hull.transform(flat.origin)};
        Contact<S> contact;
        PairCache<S>* const nothing = nullptr;
        Recorder<S>* const no_record = nullptr;
        const S separation =
            collide_hull_hull(drawn.hull, flat.hull, placed, options, nothing, contact, no_record);
        gap += separation > static_cast<S>(options.margin) ? 1 : 0;
        if (!is_clear(triangle)) continue;
        ++clear;
        ASSERT_GT(separation, static_cast<S>(options.margin)) << i << ", triangle " << triangle;
        ASSERT_TRUE(contact.points.empty());
      }
    }
  }
  EXPECT_GT(clear, 0.9 * gap);
}

TYPED_TEST(ClearTriangles, AHullHasTheContactsThatItsRecordHas) {
  using S = TypeParam;
  Random random(42);
  int points = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("hull " + std::to_string(i));
    const HullOnGrid<S> drawn = draw<S>(random);
    const Shape<S> hull = drawn.hull, grid = drawn.grid;
    CollideOptions options;
    if (random.chance(0.4)) options.margin = random.decade(-2, 0) * drawn.hull.radius;
    Manifolds<S> watched, alone;
    trace::Pair record;
    collide(hull, Pose<S>{}, grid, drawn.in_hull, options, watched, nullptr, &record);
    collide(hull, Pose<S>{}, grid, drawn.in_hull, options, alone);
    ASSERT_EQ(alone.size(), watched.size());
    for (std::size_t k = 0; k < alone.size(); ++k) {
      ASSERT_EQ(alone[k].triangle, watched[k].triangle);
      ASSERT_EQ(alone[k].normal, watched[k].normal);
      ASSERT_EQ(alone[k].points.size(), watched[k].points.size());
      for (std::size_t p = 0; p < alone[k].points.size(); ++p, ++points) {
        ASSERT_EQ(alone[k].points[p].position, watched[k].points[p].position);
        ASSERT_EQ(alone[k].points[p].separation, watched[k].points[p].separation);
        ASSERT_EQ(alone[k].points[p].id, watched[k].points[p].id);
      }
    }
  }
  EXPECT_GT(points, 300);
}

}  // namespace
}  // namespace contactscope
