#include "core/vec3.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace contactscope {
namespace {

template <class S> class AnyPerpendicular : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(AnyPerpendicular, Scalars);

TYPED_TEST(AnyPerpendicular, IsAUnitVectorAtRightAnglesAtEveryScale) {
  using S = TypeParam;
  const S tolerance = 4 * std::numeric_limits<S>::epsilon();
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const double scale : {1e-12, 1.0, 1e12}) {
    for (int i = 0; i < 200; ++i) {
      const Vec3<S> v = (scale * Vec3d(normal(random), normal(random), normal(random))).cast<S>();
      const Vec3<S> p = any_perpendicular(v);
      EXPECT_NEAR(p.norm(), 1, tolerance);
      EXPECT_NEAR(p.dot(v) / v.norm(), 0, tolerance);
    }
  }
}

TYPED_TEST(AnyPerpendicular, WorksOnTheAxesAndDiagonals) {
  using S = TypeParam;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3<S> v(static_cast<S>(x), static_cast<S>(y), static_cast<S>(z));
        const Vec3<S> p = any_perpendicular(v);
        EXPECT_NEAR(p.norm(), 1, 1e-6);
        EXPECT_NEAR(p.dot(v), 0, 1e-6);
      }
}

TEST(Perpendicular, SmallTurnsOfTheVectorAreSmallTurnsOfTheResult) {
  const Vec3d one = any_perpendicular(Vec3d(0.2, 0.9, -0.4));
  const Vec3d two = any_perpendicular(Vec3d(0.2 + 1e-9, 0.9, -0.4));
  EXPECT_LT((one - two).norm(), 1e-8);
}

}  // namespace
}  // namespace contactscope
