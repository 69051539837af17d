#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "round_hull_cases.h"

// Thousands of random spheres and capsules against random hulls, held against exhaustion over every
// feature (outside) and every axis (inside).
namespace contactscope {
namespace {

using test::Random;
using test::RoundHull;

template <class S>
class RandomRoundHull : public testing::Test {
 protected:
  static constexpr double kEpsilon = std::numeric_limits<S>::epsilon();

  struct Tally {
    int touching = 0, separated = 0, shallow = 0, deep = 0, two_points = 0;
    double worst = 0;  // roundings of the pair's scale
  };

  static void expect_right(const RoundHull& pair, Tally& tally) {
    const double rounding = kEpsilon * pair.scale() + test::unevenness(pair.hull);
    const double truth = test::brute_force_separation(pair);
    const double separation = truth - pair.radius;
    const Manifold<S> manifold = test::collide<S>(pair);
    if (std::abs(separation) > 64 * rounding) {
      ASSERT_EQ(manifold.points.empty(), separation > 0) << separation / rounding;
    }
    if (manifold.points.empty()) {
      ++tally.separated;
      return;
    }
    ++tally.touching;
    ++(truth > 0 ? tally.shallow : tally.deep);
    tally.two_points += manifold.points.size() == 2 ? 1 : 0;

    const Vec3d normal = manifold.normal.template cast<double>();
    ASSERT_TRUE(normal.allFinite());
    ASSERT_NEAR(normal.norm(), 1, 8 * kEpsilon);
    const double depth_error =
        std::abs(static_cast<double>(manifold.points[0].separation) - separation) / rounding;
    tally.worst = std::max(tally.worst, depth_error);
    ASSERT_LE(depth_error, 64) << truth / rounding << " roundings from the hull";
    // A normal that is known to rounding over the distance tells the gap to as much of the extent.
    const double along = test::core_separation_along(normal, pair);
    const double uncertain = std::abs(truth) > 64 * rounding ? rounding / std::abs(truth) : 1;
    ASSERT_GE(along, truth - 64 * rounding - (truth > 0 ? 8 * uncertain * pair.scale() : 0))
        << truth / rounding << " roundings from the hull";

    ASSERT_LE(manifold.points.size(), pair.is_sphere() ? 1u : 2u);
    for (const ContactPoint<S>& point : manifold.points) {
      ASSERT_TRUE(point.position.allFinite());
      ASSERT_TRUE(std::isfinite(point.separation));
      ASSERT_GE(point.separation, manifold.points[0].separation);
      ASSERT_LE(point.separation, S(0));
    }
    if (truth > 64 * rounding) {
      const Vec3d first = manifold.points[0].position.template cast<double>();
      const double world = pair.scale() + first.norm();
      const double allowed = 64 * kEpsilon * world + 64 * rounding;
      ASSERT_LE(test::distance_from_hull(first, pair), allowed)
          << manifold.points.size() << to_string(manifold.axis) << to_string(manifold.type)
          << to_string(manifold.points[0].id) << " " << truth / rounding << " "
          << test::core_separation_along(normal, pair) / rounding;
    }
    if (manifold.points.size() == 2) {
      ASSERT_NE(manifold.points[0].id, manifold.points[1].id);
    }
  }

  static void run(std::uint64_t seed, bool sphere, double ratio, int count, Tally& tally) {
    Random random(seed);
    for (int i = 0; i < count; ++i) {
      SCOPED_TRACE("pair " + std::to_string(i));
      expect_right(test::rounded<S>(test::random_round_hull(random, sphere, ratio)), tally);
      if (testing::Test::HasFatalFailure()) return;
    }
    std::printf("touching %d (shallow %d, deep %d, two points %d), separated %d, worst %.1f\n",
                tally.touching, tally.shallow, tally.deep, tally.two_points, tally.separated,
                tally.worst);
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(RandomRoundHull, Scalars);

TYPED_TEST(RandomRoundHull, SpheresAgreeWithExhaustion) {
  typename TestFixture::Tally tally;
  TestFixture::run(1, true, 100, 4000, tally);
  EXPECT_GT(tally.shallow, 1000);
  EXPECT_GT(tally.deep, 300);
  EXPECT_GT(tally.separated, 100);
}

TYPED_TEST(RandomRoundHull, SpheresOfVeryDifferentSizeAgreeWithExhaustion) {
  typename TestFixture::Tally tally;
  TestFixture::run(2, true, 1e4, 2000, tally);
  EXPECT_GT(tally.touching, 1000);
}

TYPED_TEST(RandomRoundHull, CapsulesAgreeWithExhaustion) {
  typename TestFixture::Tally tally;
  TestFixture::run(3, false, 30, 4000, tally);
  EXPECT_GT(tally.shallow, 500);
  EXPECT_GT(tally.deep, 1000);
  EXPECT_GT(tally.two_points, 100);
}

TYPED_TEST(RandomRoundHull, CapsulesOfVeryDifferentSizeAgreeWithExhaustion) {
  typename TestFixture::Tally tally;
  TestFixture::run(4, false, 1e4, 2000, tally);
  EXPECT_GT(tally.touching, 1000);
}

}  // namespace
}  // namespace contactscope
