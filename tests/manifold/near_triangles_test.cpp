#include "manifold/internal_edges.h"

#include <gtest/gtest.h>

#include <vector>

#include "geometry/primitives.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Random;

template <class S> class NearTrianglesOfGrids : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(NearTrianglesOfGrids, Scalars);

template <class S> Aabb<S> box_at(const Vec3d& middle, double reach) {
  const Vec3d to_side = Vec3d::Constant(reach);
  return Aabb<double>{middle - to_side, middle + to_side}.cast<S>();
}

TYPED_TEST(NearTrianglesOfGrids, AnswerAsTheTreeDoesInItsOrder) {
  using S = TypeParam;
  Random random(61);
  const Mesh<S> mesh = mesh_cast<S>(make_grid(8, 8, 24, 24, 0.3));
  int few = 0, many = 0, inside = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3d middle = random.level(4, 0);
    const double reach = random.decade(-1.5, 0.6);
    const NearTriangles<S> near(mesh, box_at<S>(middle, reach));
    std::vector<int> listed, found;
    const int skipped = random.index(3);
    const auto skips = [skipped](int triangle) { return triangle % 3 == skipped; };
    near.each(skips, [&](int triangle) { listed.push_back(triangle); });
    mesh.tree.query(box_at<S>(middle, reach), [&](int triangle) {
      if (!skips(triangle)) found.push_back(triangle);
    });
    ASSERT_EQ(listed, found);
    ++(found.size() > 128 ? many : few);
    for (int k = 0; k < 10; ++k) {
      const Aabb<S> requested =
          box_at<S>(middle + random.vector(-reach, reach), reach * random.decade(-2, 0));
      inside += box_at<S>(middle, reach).contains(requested) ? 1 : 0;
      std::vector<int> heard, expected;
      const int last = random.index(12);
      const auto query_pair = [last](std::vector<int>& into) {
        return [&into, last](int triangle) {
          into.push_back(triangle);
          return triangle % 12 == last;
        };
      };
      ASSERT_EQ(near.any_of(requested, query_pair(heard)),
                mesh.tree.any_of(requested, query_pair(expected)));
      ASSERT_EQ(heard, expected);
    }
  }
  EXPECT_GT(few, 200);
  EXPECT_GT(many, 50);
  EXPECT_GT(inside, 500);
}

}  // namespace
}  // namespace contactscope
