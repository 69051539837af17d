#include "manifold/clear_of_triangle.h"

#include <gtest/gtest.h>

#include <string>

#include "geometry/primitives.h"
#include "geometry/triangle_hull.h"
#include "manifold/collide_pairs.h"
#include "manifold/dispatch.h"
#include "support/random_geometry.h"

// What a box is told to pass over it does not touch, and nothing of its contacts is lost.
namespace contactscope {
namespace {

using test::Random;

template <class S>
struct BoxOnGrid {
  Hull<S> box;
  Mesh<S> grid;
  Pose<S> in_box;
};

template <class S>
BoxOnGrid<S> draw(Random& random) {
  const double size = random.chance(0.5) ? 1 : random.decade(-4, 4);
  const double amplitude = random.chance(0.3) ? 0 : size * random.uniform(0, 0.2);
  const Shape<double> grid = make_grid(4 * size, 4 * size, 8, 8, amplitude);
  Pose<double> in_box;
  if (random.chance(0.7)) in_box.rotation = random.rotation();
  in_box.position = size * random.vector(-1, 1);
  Vec3d half;
  for (int k = 0; k < 3; ++k) half[k] = size * random.uniform(0.1, 0.6);
  return {hull_cast<S>(make_box(half)), std::get<Mesh<S>>(shape_cast<S>(grid)), in_box.cast<S>()};
}

template <class S>
class ClearTriangles : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ClearTriangles, Scalars);

TYPED_TEST(ClearTriangles, AreApartByTheSeparatingAxisTest) {
  using S = TypeParam;
  Random random(41);
  int clear = 0, apart = 0;
  for (int i = 0; i < 200; ++i) {
    const BoxOnGrid<S> drawn = draw<S>(random);
    const S reach = drawn.box.radius + drawn.in_box.position.norm();
    for (const double margin : {0.0, 0.05}) {
      CollideOptions options;
      options.margin = margin * drawn.box.radius;
      const ClearOfTriangle<S> is_clear(drawn.box, drawn.grid, drawn.in_box,
                                        static_cast<S>(options.margin), reach);
      for (int triangle = 0; triangle < drawn.grid.triangle_count(); ++triangle) {
        TriangleHull<S> hull;
        hull.set(drawn.grid, triangle);
        const Pose<S> placed{drawn.in_box.rotation, drawn.in_box.transform(hull.origin)};
        Contact<S> contact;
        PairCache<S>* const nothing = nullptr;
        Recorder<S>* const nobody = nullptr;
        const S separation =
            collide_hull_hull(drawn.box, hull.hull, placed, options, nothing, contact, nobody);
        apart += separation > static_cast<S>(options.margin) ? 1 : 0;
        if (!is_clear(triangle)) continue;
        ++clear;
        ASSERT_GT(separation, static_cast<S>(options.margin)) << i << ", triangle " << triangle;
        ASSERT_TRUE(contact.points.empty());
      }
    }
  }
  EXPECT_GT(clear, 0.9 * apart);
}

TYPED_TEST(ClearTriangles, ABoxHasTheContactsThatItsRecordHas) {
  using S = TypeParam;
  Random random(42);
  int points = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("box " + std::to_string(i));
    const BoxOnGrid<S> drawn = draw<S>(random);
    const Shape<S> box = drawn.box, grid = drawn.grid;
    Manifolds<S> watched, alone;
    trace::Pair record;
    collide(box, Pose<S>{}, grid, drawn.in_box, {}, watched, nullptr, &record);
    collide(box, Pose<S>{}, grid, drawn.in_box, {}, alone);
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
