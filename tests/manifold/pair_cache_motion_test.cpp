#include "manifold/pair_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "manifold/dispatch.h"
#include "manifold/fast/fast_pairs.h"
#include "moving_pairs.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"

namespace contactscope {
namespace {

using test::Motion;
using test::PairCase;
using test::Random;
using test::same_bits;
using test::touching_pair;

template <class S> double best_separation(const PairCase<S>& pair) {
  const PairCase<double> exact = pair.template cast<double>();
  const HullPair<double> placed(exact.a, exact.b, relative_pose(exact.pose_a, exact.pose_b));
  const SatResult<double> axes = sat(placed, 0.0, Preference::None);
  return axes.separation(axes.status == SatStatus::Separated ? axes.chosen : axes.deepest);
}

template <class S> class PairCacheMotion : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(PairCacheMotion, Scalars);

TYPED_TEST(PairCacheMotion, SlowResultsEqualThoseWithoutACacheUpToThePreference) {
  using S = TypeParam;
  constexpr int kPairs = 200;
  constexpr int kFrames = 120;
  Random random(20150306);
  int frames = 0, touching = 0, separated = 0;
  int hits[4] = {};
  for (int i = 0; i < kPairs; ++i) {
    Vec3d normal;
    const PairCase<double> start = touching_pair(random, normal);
    const double size = std::max(start.a.radius, start.b.radius);
    const std::vector<Motion> all = motions(random, normal);
    const Pose<double> place = random.pose(3 * size);
    PairCase<S> pair = test::moved(start, place).template cast<S>();
    CollideOptions options;
    options.margin = i % 4 == 3 ? S(0.005 * size) : S(0);
    for (std::size_t m = 0; m < all.size(); ++m) {
      PairCache<S> cache;
      for (int k = 0; k < kFrames; ++k) {
        SCOPED_TRACE(std::string(all[m].name) + ", pair " + std::to_string(i) + ", frame " +
                     std::to_string(k));
        Pose<double> moved = compose(place, all[m].pose(start.pose_b, size, k));
        moved.rotation.normalize();
        pair.pose_b = moved.template cast<S>();
        const Pose<S> b_in_a = relative_pose(pair.pose_a, pair.pose_b);

        const bool features = cache.kind == CachedKind::Features;
        Contact<S> tried;
        const CacheAnswer<S> answer =
            collide_from_cache<S>(pair.a, pair.b, b_in_a, options, cache, tried, nullptr);
        const Manifold<S> cached =
            collide_hull_hull(pair.a, pair.pose_a, pair.b, pair.pose_b, options, &cache);
        const Manifold<S> cold =
            collide_hull_hull(pair.a, pair.pose_a, pair.b, pair.pose_b, options);
        ++frames;
        hits[m] += answer.hit;

        const double best = best_separation(pair);
        const double rounding = 32 * std::numeric_limits<S>::epsilon() * test::length_scale(pair);
        const double margin = static_cast<double>(options.margin);
        if (best < -rounding) {
          ASSERT_FALSE(cached.points.empty()) << best;
        }
        if (best > margin + rounding) {
          ASSERT_TRUE(cached.points.empty()) << best;
        }
        if (margin == 0 && std::abs(best) > rounding) {
          ASSERT_EQ(cached.points.empty(), cold.points.empty());
        }
        if (!answer.hit) {
          ASSERT_TRUE(same_bits(cached, cold));
        }
        if (cached.points.empty()) {
          ++separated;
          continue;
        }
        ++touching;
        if (answer.hit) {
          ASSERT_TRUE(features);
        }

        // The axis is within the preference of the best one, measured by the vertices alone.
        const PairCase<double> exact = pair.template cast<double>();
        const double along = test::separation_along(cached.normal.template cast<double>(), exact.a,
                                                    exact.pose_a, exact.b, exact.pose_b);
        const double smaller = std::min(exact.a.radius, exact.b.radius);
        const double preference =
            std::max(0.05 * std::max(-best, 0.0), 0.002 * smaller) + 2 * rounding;
        ASSERT_GE(along, best - preference);
        ASSERT_LE(test::deepest(cached), std::max(best, along) + preference);
        ASSERT_GE(test::deepest(cached), along - 2 * rounding);
        // The same axis gives the same manifold. Separated edges are measured by support points,
        // and either end of an edge may be the support point.
        const bool by_support = cold.axis == AxisKind::EdgeEdge && best > -rounding;
        if (cached.axis == cold.axis && cached.normal == cold.normal && !by_support) {
          ASSERT_TRUE(same_bits(cached, cold));
        }
        if (k % 40 == 7 && exact.a.vertices.size() + exact.b.vertices.size() <= 32) {
          const test::BruteForceAxis oracle =
              test::brute_force_sat(exact.a, exact.pose_a, exact.b, exact.pose_b);
          if (oracle.separation < 0) {
            ASSERT_GE(along, oracle.separation - preference);
          }
        }
      }
    }
  }
  const double each = double(kPairs) * kFrames;
  std::printf("%d frames, %d touching, %d separated; hits:", frames, touching, separated);
  for (const int count : hits) std::printf(" %.3f", count / each);
  std::printf("\n");
  EXPECT_GT(touching, frames / 3);
  EXPECT_GT(separated, frames / 10);
  EXPECT_GT(hits[0], 0.8 * each);
  EXPECT_GT(hits[1], 0.5 * each);
  EXPECT_GT(hits[2], 0.3 * each);
  EXPECT_GT(hits[3], 0.6 * each);
}

TEST(PairCacheHistory, TheSameHistoryGivesTheSameBitsWatchedOrNot) {
  Random random(77);
  for (int i = 0; i < 20; ++i) {
    Vec3d normal;
    const PairCase<double> start = touching_pair(random, normal);
    const Shape<float> a = hull_cast<float>(start.a);
    const Shape<float> b = hull_cast<float>(start.b);
    const double size = start.a.radius;
    CollideOptions options;
    options.reducer = find_reducer("area");
    for (const Motion& motion : motions(random, normal)) {
      PairCache<float> watched_cache, cache;
      for (int k = 0; k < 60; ++k) {
        const Pose<float> pose_a = start.pose_a.cast<float>();
        const Pose<float> pose_b = motion.pose(start.pose_b, size, k).cast<float>();
        Manifolds<float> watched, unwatched;
        trace::Pair record;
        collide(a, pose_a, b, pose_b, options, watched, &watched_cache, &record);
        collide(a, pose_a, b, pose_b, options, unwatched, &cache);
        ASSERT_EQ(watched.size(), unwatched.size());
        if (!watched.empty()) {
          ASSERT_TRUE(same_bits(watched[0], unwatched[0]));
        }

        // The record shows the path that ran.
        const bool hit = record.cache && record.cache->hit;
        ASSERT_EQ(record.sat.has_value(), !hit);
        ASSERT_EQ(record.cache && record.cache->normal, hit);
        const bool on_face = !watched.empty() && watched[0].axis != AxisKind::EdgeEdge;
        ASSERT_EQ(record.clip.has_value(), on_face);
        if (hit && !watched.empty()) {
          ASSERT_EQ(record.cache->kind, "features");
          ASSERT_EQ(record.cache->axis, record.manifolds[0].axis);
          ASSERT_EQ(*record.cache->normal, record.manifolds[0].normal);
        }
        if (hit && watched.empty()) {
          ASSERT_EQ(record.cache->kind, "separating_axis");
        }
        if (record.cache && record.cache->kind == "features") {
          ASSERT_GE(*record.cache->moved, 0);
        }
      }
    }
  }
}

// Boxes have a cached path of their own when nothing records; it must report the same hits.
TYPED_TEST(PairCacheMotion, SlowTwoBoxesGiveTheSameBitsWatchedOrNot) {
  using S = TypeParam;
  Random random(78);
  int by_themselves = 0, touching = 0;
  for (int i = 0; i < 150; ++i) {
    const double size = random.decade(-4, 4);
    PairCase<double> start{
        test::random_box(random, size, 4), {}, test::random_box(random, size, 4), {}};
    start.pose_b = {
        random.chance(0.7) ? random.rotation_by(random.decade(-7, -1)) : random.rotation(),
        0.5 * size * random.unit_vector()};
    const test::BruteForceAxis axis =
        test::brute_force_sat(start.a, start.pose_a, start.b, start.pose_b);
    start.pose_b.position += (-random.uniform(0, 0.02) * size - axis.separation) * axis.normal;
    const Pose<double> place = random.pose(2 * size);
    const Hull<S> hull_a = hull_cast<S>(start.a), hull_b = hull_cast<S>(start.b);
    const Shape<S> a = hull_a, b = hull_b;
    CollideOptions options;
    options.margin = i % 3 == 0 ? 0.003 * size : 0;
    if (i % 2 == 0) options.reducer = find_reducer("area");
    for (const Motion& motion : motions(random, axis.normal)) {
      PairCache<S> watched_cache, cache;
      for (int k = 0; k < 60; ++k) {
        SCOPED_TRACE(std::string(motion.name) + ", pair " + std::to_string(i) + ", frame " +
                     std::to_string(k));
        Pose<double> moved = compose(place, motion.pose(start.pose_b, size, k));
        moved.rotation.normalize();
        const Pose<S> pose_a = place.template cast<S>(), pose_b = moved.template cast<S>();
        Manifolds<S> watched, unwatched, alone;
        by_themselves +=
            collide_boxes_from_cache(hull_a, pose_a, hull_b, pose_b, options, cache, alone);
        trace::Pair record;
        collide(a, pose_a, b, pose_b, options, watched, &watched_cache, &record);
        collide(a, pose_a, b, pose_b, options, unwatched, &cache);
        ASSERT_EQ(watched.size(), unwatched.size());
        if (watched.empty()) continue;
        ++touching;
        ASSERT_TRUE(same_bits(watched[0], unwatched[0]));
      }
    }
  }
  std::printf("%d frames of boxes, %d touching, %d by what boxes keep\n", 150 * 4 * 60, touching,
              by_themselves);
  EXPECT_GT(touching, 150 * 4 * 60 / 2);
  EXPECT_GT(by_themselves, touching / 2);
}

TEST(PairCacheHistory, TheRecordHasTheMotionOfTheSecondBox) {
  const PairCase<double> start = test::stacked_cubes(0.4, 0.005);
  const Shape<double> a = start.a, b = start.b;
  PairCache<double> cache;
  Manifolds<double> manifolds;
  collide(a, start.pose_a, b, start.pose_b, {}, manifolds, &cache);
  // Displacement counts from the frame of the last full test.
  for (const double offset : {0.01, 0.02, 0.04}) {
    Pose<double> moved = start.pose_b;
    moved.position.x() += offset;
    trace::Pair record;
    collide(a, start.pose_a, b, moved, {}, manifolds, &cache, &record);
    ASSERT_TRUE(record.cache && record.cache->hit);
    ASSERT_TRUE(record.cache->moved.has_value());
    EXPECT_NEAR(*record.cache->moved, offset, 1e-12);
    ASSERT_TRUE(record.cache->normal.has_value());
    EXPECT_NEAR(record.cache->normal->y(), 1, 1e-12);
  }
}

}  // namespace
}  // namespace contactscope
