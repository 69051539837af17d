#include "query/support_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "geometry/primitives.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

template <class S> class Support : public testing::Test {};

using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Support, Scalars);

/// Every remainder of the lane width; origins inside and far outside, where padded zeros would win.
TYPED_TEST(Support, LanesFindAVertexAsFarAsAnyOther) {
  using S = TypeParam;
  test::Random random(32);
  for (int vertices = 4; vertices < 40; ++vertices) {
    Hull<double> exact = test::random_hull(random, vertices, 1, 1);
    if (vertices % 2 == 0) {
      for (Vec3d& vertex : exact.vertices) vertex += Vec3d(50, 60, 70);
    }
    const Hull<S> hull = hull_cast<S>(exact);
    const SupportSet<S> set = support_set(hull);
    for (int i = 0; i < 50; ++i) {
      const Vec3<S> direction = random.unit_vector().cast<S>();
      const int index = support_index(set, direction);
      ASSERT_GE(index, 0);
      ASSERT_LT(index, hull.vertex_count());
      const double found =
          static_cast<double>(direction.dot(hull.vertices[static_cast<std::size_t>(index)]));
      double farthest = -std::numeric_limits<double>::infinity();
      for (const Vec3<S>& vertex : hull.vertices)
        farthest = std::max(farthest, static_cast<double>(direction.dot(vertex)));
      const double rounding = 200 * static_cast<double>(std::numeric_limits<S>::epsilon());
      EXPECT_NEAR(found, farthest, rounding) << vertices << " vertices";
    }
  }
}

TYPED_TEST(Support, PointsAndSegmentsGiveTheirFartherEnd) {
  using S = TypeParam;
  const Vec3<S> ends[2] = {Vec3<S>(1, 0, 0), Vec3<S>(3, 4, 0)};
  EXPECT_EQ(support_index(support_set(ends), Vec3<S>(1, 0, 0)), 1);
  EXPECT_EQ(support_index(support_set(ends), Vec3<S>(0, -1, 0)), 0);
  EXPECT_EQ(support_index(support_set(ends[1]), Vec3<S>(0, -1, 0)), 0);
  EXPECT_EQ(middle_of(support_set(ends)), Vec3<S>(2, 2, 0));
  EXPECT_EQ(reach_of(support_set(ends)), S(5));
}

TYPED_TEST(Support, ReachBoundsEveryVertex) {
  using S = TypeParam;
  const Hull<S> hull = hull_cast<S>(make_box({1, 2, 2}));
  EXPECT_GE(reach_of(support_set(hull)), S(3) * (1 - std::numeric_limits<S>::epsilon()));
  EXPECT_LE(reach_of(support_set(hull)), S(4));
}

}  // namespace
}  // namespace contactscope
