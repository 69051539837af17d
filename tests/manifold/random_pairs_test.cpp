#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "manifold/collide_pairs.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"
#include "support/pair_case.h"

// Ten thousand random pairs against a brute-force separating axis test in double over every axis.
namespace contactscope {
namespace {

using test::deepest;
using test::PairCase;
using test::Random;

constexpr int kPairs = 10000;

template <class S> bool all_finite(const Manifold<S>& manifold) {
  bool finite = manifold.normal.allFinite();
  for (const ContactPoint<S>& point : manifold.points) {
    finite = finite && point.position.allFinite() && std::isfinite(point.separation);
  }
  return finite;
}

template <class S>
Manifold<S> collide(const PairCase<S>& pair, Preference preference, const ReducerInfo* reducer) {
  CollideOptions options;
  options.preference = preference;
  options.reducer = reducer;
  return collide_hull_hull(pair.a, pair.pose_a, pair.b, pair.pose_b, options);
}

template <class S> class RandomPairs : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(RandomPairs, Scalars);

TYPED_TEST(RandomPairs, SlowAgreeWithBruteForceOverEveryAxis) {
  using S = TypeParam;
  Random random(20150302);
  int touching = 0;
  int separated = 0;
  int clear_cut = 0;
  double worst_depth = 0;
  for (int i = 0; i < kPairs; ++i) {
    SCOPED_TRACE("pair " + std::to_string(i));
    const PairCase<S> pair = test::random_pair(random).template cast<S>();
    const PairCase<double> exact = pair.template cast<double>();
    const test::BruteForceAxis best =
        test::brute_force_sat(exact.a, exact.pose_a, exact.b, exact.pose_b);
    // Rounding: a few dozen operations on coordinates of this size.
    const double ulps = test::length_scale(exact) * std::numeric_limits<S>::epsilon();
    const double rounding = 32 * ulps;

    const Manifold<S> pure = collide<S>(pair, Preference::None, nullptr);
    const Manifold<S> preferred = collide<S>(pair, Preference::Relative, nullptr);
    ASSERT_TRUE(all_finite(pure));
    ASSERT_TRUE(all_finite(preferred));

    if (std::abs(best.separation) > rounding) {
      ++clear_cut;
      ASSERT_EQ(pure.points.empty(), best.separation > 0) << best.separation / ulps << " ulps";
      ASSERT_EQ(preferred.points.empty(), best.separation > 0) << best.separation / ulps;
    }
    if (best.separation > 0 || pure.points.empty() || preferred.points.empty()) {
      ++separated;
      continue;
    }
    ++touching;

    // The true minimum: its depth, and a normal along which the separation is that depth.
    worst_depth = std::max(worst_depth, std::abs(deepest(pure) - best.separation) / ulps);
    ASSERT_NEAR(deepest(pure), best.separation, 2 * rounding) << ulps;
    ASSERT_NEAR(pure.normal.norm(), 1, 8 * std::numeric_limits<S>::epsilon());
    const double along = test::separation_along(pure.normal.template cast<double>(), exact.a,
                                                exact.pose_a, exact.b, exact.pose_b);
    ASSERT_NEAR(along, best.separation, rounding);

    // With the preference: neither deeper nor shallower than documented.
    const double smaller = std::min(exact.a.radius, exact.b.radius);
    const double allowed = std::max(0.05 * -best.separation, 0.002 * smaller) + 2 * rounding;
    ASSERT_NEAR(deepest(preferred), best.separation, allowed);
    ASSERT_LE(deepest(preferred), 0.95 * best.separation + 2 * rounding);
  }
  this->RecordProperty("worst_depth_in_ulps", std::to_string(worst_depth));
  std::printf("touching %d, separated %d, clear-cut %d, worst depth error %.1f ulps\n", touching,
              separated, clear_cut, worst_depth);
  EXPECT_GT(touching, kPairs / 3);
  EXPECT_GT(separated, kPairs / 10);
  EXPECT_GT(clear_cut, kPairs * 3 / 4);
}

}  // namespace
}  // namespace contactscope
