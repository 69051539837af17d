#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "round_hull_cases.h"
#include "support/builders.h"

// Random spheres and capsules against random hulls, compared with exhaustion over every feature
// (outside) and every axis (inside).
namespace contactscope {
namespace {

using test::Random;
using test::RoundHull;

template <class S> class RandomRoundHull : public testing::Test {
 protected:
  static constexpr double kEpsilon = std::numeric_limits<S>::epsilon();

  /// A few dozen operations on numbers of the pair's scale.
  static constexpr double kRoundings = 32;

  struct Tally {
    int touching = 0, separated = 0, shallow = 0, deep = 0, two_points = 0;
    // In roundings of the pair's scale; for the normal, times the distance.
    double worst_depth = 0, worst_normal = 0;
  };

  static void expect_right(const RoundHull& pair, Tally& tally) {
    const double rounding = kEpsilon * pair.scale() + test::unevenness(pair.hull);
    const double truth = test::brute_force_separation(pair);
    const double separation = truth - pair.radius;
    const Manifold<S> manifold = test::collide<S>(pair);
    if (std::abs(separation) > kRoundings * rounding) {
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
    const double depth_error = std::abs(test::deepest(manifold) - separation) / rounding;
    tally.worst_depth = std::max(tally.worst_depth, depth_error);
    ASSERT_LE(depth_error, kRoundings) << truth / rounding << " roundings from the hull";
    if (truth > kRoundings * rounding) {
      // The direction between two points is exact up to the rounding of the points.
      const double turned = (normal - test::brute_force_normal(pair)).norm() * truth / rounding;
      tally.worst_normal = std::max(tally.worst_normal, turned);
      ASSERT_LE(turned, kRoundings) << truth / rounding << " roundings from the hull";
    } else if (truth <= 0) {
      ASSERT_GE(test::core_separation_along(normal, pair), truth - kRoundings * rounding);
    }
    expect_points(pair, manifold, truth, rounding);
  }

  static void expect_points(const RoundHull& pair, const Manifold<S>& manifold, double truth,
                            double rounding) {
    ASSERT_LE(manifold.points.size(), pair.is_sphere() ? 1u : 2u);
    if (manifold.points.size() == 2) {
      ASSERT_NE(manifold.points[0].id, manifold.points[1].id);
    }
    // Directions count as nearly parallel up to a sine of 0.05.
    const double aside = 0.06 * (pair.core.front() - pair.core.back()).norm() + 0.06 * truth;
    for (const ContactPoint<S>& point : manifold.points) {
      ASSERT_TRUE(point.position.allFinite());
      ASSERT_TRUE(std::isfinite(point.separation));
      ASSERT_GE(point.separation, manifold.points[0].separation - 8 * rounding);
      ASSERT_LE(point.separation, S(0));
      if (truth < kRoundings * rounding) continue;
      const Vec3d position = point.position.template cast<double>();
      const double world = kEpsilon * (pair.scale() + position.norm()) + rounding;
      const bool is_first = &point == &manifold.points[0];
      const bool is_closest = is_first && manifold.type != ContactType::EdgeEdge;
      ASSERT_LE(test::distance_from_hull(position, pair),
                kRoundings * world + (is_closest ? 0 : aside))
          << to_string(manifold.type) << " " << to_string(point.id);
    }
  }

  static void run(std::uint64_t seed, bool sphere, double ratio, int count, Tally& tally) {
    Random random(seed);
    for (int i = 0; i < count; ++i) {
      SCOPED_TRACE("pair " + std::to_string(i));
      expect_right(test::rounded<S>(test::random_round_hull(random, sphere, ratio)), tally);
      if (testing::Test::HasFatalFailure()) return;
    }
    testing::Test::RecordProperty("worst_depth_roundings", std::to_string(tally.worst_depth));
    testing::Test::RecordProperty("worst_normal_roundings", std::to_string(tally.worst_normal));
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(RandomRoundHull, Scalars);

TYPED_TEST(RandomRoundHull, SlowSpheresAgreeWithExhaustion) {
  typename TestFixture::Tally tally;
  TestFixture::run(1, true, 100, 4000, tally);
  EXPECT_GT(tally.shallow, 1000);
  EXPECT_GT(tally.deep, 300);
  EXPECT_GT(tally.separated, 100);
}

TYPED_TEST(RandomRoundHull, SlowSpheresOfVeryDifferentSizeAgreeWithExhaustion) {
  typename TestFixture::Tally tally;
  TestFixture::run(2, true, 1e4, 2000, tally);
  EXPECT_GT(tally.touching, 1000);
}

TYPED_TEST(RandomRoundHull, SlowCapsulesAgreeWithExhaustion) {
  typename TestFixture::Tally tally;
  TestFixture::run(3, false, 30, 4000, tally);
  EXPECT_GT(tally.shallow, 500);
  EXPECT_GT(tally.deep, 1000);
  EXPECT_GT(tally.two_points, 100);
}

TYPED_TEST(RandomRoundHull, SlowCapsulesOfVeryDifferentSizeAgreeWithExhaustion) {
  typename TestFixture::Tally tally;
  TestFixture::run(4, false, 1e4, 2000, tally);
  EXPECT_GT(tally.touching, 1000);
}

}  // namespace
}  // namespace contactscope
