#include "manifold/pair_cache.h"

#include <gtest/gtest.h>

#include <limits>

#include "manifold/dispatch.h"
#include "moving_pairs.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"
#include "support/cases.h"

namespace contactscope {
namespace {

using test::PairCase;
using test::Random;
using test::same_bits;
using test::touching_pair;

template <class S> PairCase<S> resting() {
  return test::stacked_cubes(0.4, 0.005).template cast<S>();
}

template <class S>
CacheAnswer<S> query_pair(const PairCase<S>& pair, const PairCache<S>& cache,
                          const CollideOptions& options = {}) {
  Contact<S> contact;
  return collide_from_cache<S>(pair.a, pair.b, relative_pose(pair.pose_a, pair.pose_b), options,
                               cache, contact, nullptr);
}

template <class S>
Manifold<S> collide(const PairCase<S>& pair, PairCache<S>& cache,
                    const CollideOptions& options = {}) {
  return collide_hull_hull(pair.a, pair.pose_a, pair.b, pair.pose_b, options, &cache);
}

TEST(PairCache, IsEmptyAtFirstAndHoldsTheFeaturesOfATouchingPair) {
  const PairCase<float> pair = resting<float>();
  PairCache<float> cache;
  EXPECT_FALSE(query_pair(pair, cache).hit);
  EXPECT_EQ(query_pair(pair, cache).kind, CachedKind::Empty);
  const Manifold<float> first = collide(pair, cache);
  EXPECT_EQ(cache.kind, CachedKind::Features);
  EXPECT_TRUE(query_pair(pair, cache).hit);
  EXPECT_TRUE(same_bits(first, collide(pair, cache)));
}

TEST(PairCache, BoxesAtRestMayMoveBySeveralPercentOfTheirSize) {
  PairCase<double> pair = resting<double>();
  PairCache<double> cache;
  collide(pair, cache);
  pair.pose_b.position.x() += 0.04;
  EXPECT_TRUE(query_pair(pair, cache).hit);
  EXPECT_NEAR(query_pair(pair, cache).moved, 0.04, 1e-12);
  pair.pose_b.position.x() += 0.4;
  EXPECT_FALSE(query_pair(pair, cache).hit);
  EXPECT_EQ(query_pair(pair, cache).kind, CachedKind::Features);
}

TEST(PairCache, NoPointRelativeToTheOtherHullMovesFartherThanTheBound) {
  Random random(8);
  for (int i = 0; i < 300; ++i) {
    Vec3d normal;
    PairCase<double> pair = touching_pair(random, normal);
    const double size = pair.a.radius;
    PairCache<double> cache;
    collide(pair, cache);
    if (cache.kind != CachedKind::Features) continue;
    const PairCase<double> before = pair;
    const double turn = random.decade(-6, 0);
    pair.pose_b.rotation = random.rotation_by(turn) * pair.pose_b.rotation;
    pair.pose_b.position += random.decade(-6, -1) * size * random.unit_vector();
    // The same rotation may come with either sign.
    if (random.chance(0.5)) pair.pose_b.rotation.coeffs() *= -1;
    const CacheAnswer<double> answer = query_pair(pair, cache);
    if (answer.kind != CachedKind::Features) continue;

    double farthest = 0;
    const Pose<double> old_pose = relative_pose(before.pose_a, before.pose_b);
    const Pose<double> new_pose = relative_pose(pair.pose_a, pair.pose_b);
    for (const Vec3d& v : pair.b.vertices) {
      farthest = std::max(farthest, (new_pose.transform(v) - old_pose.transform(v)).norm());
    }
    for (const Vec3d& v : pair.a.vertices) {
      const Vec3d moved = new_pose.inverse_transform(v) - old_pose.inverse_transform(v);
      farthest = std::max(farthest, moved.norm());
    }
    EXPECT_GE(answer.moved, farthest * (1 - 1e-9) - 1e-12 * size);
    EXPECT_LE(answer.moved, 4 * farthest);
  }
}

// The vertex that was deepest at the full test may not be the deepest now.
TEST(PairCache, AlongTheKeptFaceTheSeparationIsThatOfTheDeepestVertexByNow) {
  Random random(9);
  int hits = 0;
  for (int i = 0; i < test::cases(3000); ++i) {
    Vec3d normal;
    PairCase<double> pair = touching_pair(random, normal);
    const double size = pair.a.radius;
    PairCache<double> cache;
    collide(pair, cache);
    if (cache.kind != CachedKind::Features || cache.axis == AxisKind::EdgeEdge) continue;
    pair.pose_b.rotation = random.rotation_by(random.decade(-5, -1)) * pair.pose_b.rotation;
    pair.pose_b.position += random.decade(-5, -2) * size * random.unit_vector();
    const CacheAnswer<double> answer = query_pair(pair, cache);
    if (!answer.hit) continue;
    ++hits;
    const Vec3d offset = pair.pose_a.rotate(answer.normal);
    ASSERT_NEAR(test::separation_along(offset, pair.a, pair.pose_a, pair.b, pair.pose_b),
                answer.separation, 1e-12 * size)
        << i;
  }
  EXPECT_GT(hits, 500 / test::kOneIn);
}

TEST(PairCache, ABoxThatSlidesOverTheRimIsPushedOutSideways) {
  // Far from the cached axis another one becomes shallower. Only the bound can notice this.
  PairCase<double> pair{test::cube(0.5), test::at(0, 0, 0), test::cube(0.5),
                        test::at(0.9, 0.95, 0)};
  PairCache<double> cache;
  EXPECT_NEAR(collide(pair, cache).normal.y(), 1, 1e-12);
  EXPECT_EQ(cache.kind, CachedKind::Features);
  pair.pose_b.position.x() = 0.98;
  const Manifold<double> pushed = collide(pair, cache);
  EXPECT_NEAR(pushed.normal.x(), 1, 1e-12);
  EXPECT_NEAR(test::deepest(pushed), -0.02, 1e-12);
}

TEST(PairCache, TheLastSeparatingAxisIsTriedFirst) {
  PairCase<float> pair = resting<float>();
  pair.pose_b.position.y() += 0.1f;
  PairCache<float> cache;
  EXPECT_TRUE(collide(pair, cache).points.empty());
  EXPECT_EQ(cache.kind, CachedKind::SeparatingAxis);
  pair.pose_b.position.x() += 0.3f;
  const CacheAnswer<float> answer = query_pair(pair, cache);
  EXPECT_TRUE(answer.hit);
  EXPECT_NEAR(answer.separation, 0.095f, 1e-5f);
  pair.pose_b.position.y() -= 0.1f;
  EXPECT_FALSE(query_pair(pair, cache).hit);
  EXPECT_TRUE(same_bits(collide(pair, cache), test::collide(pair)));
  EXPECT_EQ(cache.kind, CachedKind::Features);
}

TEST(PairCache, TheCrossProductOfTheLastEdgesSeparatesToo) {
  PairCase<float> pair = test::crossed_edges(1, -0.02).cast<float>();
  PairCache<float> cache;
  EXPECT_TRUE(collide(pair, cache).points.empty());
  EXPECT_EQ(cache.axis, AxisKind::EdgeEdge);
  pair.pose_b.position += Vec3f(0.1f, -0.01f, 0.1f);
  EXPECT_TRUE(query_pair(pair, cache).hit);
  EXPECT_NEAR(query_pair(pair, cache).separation, 0.01f, 1e-5f);
}

TEST(PairCache, SeparatedFeaturesSeparateThePairAndAreKept) {
  PairCase<float> pair = resting<float>();
  PairCache<float> cache;
  const Manifold<float> before = collide(pair, cache);
  pair.pose_b.position.y() += 0.01f;
  const CacheAnswer<float> gap = query_pair(pair, cache);
  EXPECT_TRUE(gap.hit);
  EXPECT_EQ(gap.kind, CachedKind::SeparatingAxis);
  EXPECT_TRUE(collide(pair, cache).points.empty());
  pair.pose_b = resting<float>().pose_b;
  EXPECT_EQ(query_pair(pair, cache).kind, CachedKind::Features);
  EXPECT_TRUE(same_bits(before, collide(pair, cache)));
}

TEST(PairCache, WithoutAPreferenceOnlySeparatingAxesAreKept) {
  CollideOptions options;
  options.preference = Preference::None;
  PairCase<double> pair = resting<double>();
  PairCache<double> cache;
  collide(pair, cache, options);
  EXPECT_EQ(cache.kind, CachedKind::Empty);
  pair.pose_b.position.y() += 0.1;
  collide(pair, cache, options);
  EXPECT_TRUE(query_pair(pair, cache, options).hit);
  // Features cached under another preference are not used.
  pair = resting<double>();
  PairCache<double> preferring;
  collide(pair, preferring);
  EXPECT_TRUE(query_pair(pair, preferring).hit);
  EXPECT_FALSE(query_pair(pair, preferring, options).hit);
}

TEST(PairCache, AnotherPairDoesNoHarm) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const PairCase<float> one = test::random_pair(random).cast<float>();
    PairCase<float> other = test::random_pair(random).cast<float>();
    PairCache<float> cache;
    collide(one, cache);
    const PairCache<float> foreign = cache;
    if (other.a.radius != one.a.radius) {
      EXPECT_EQ(query_pair(other, foreign).kind, CachedKind::Empty);
      const Manifold<float> result = collide(other, cache);
      EXPECT_TRUE(same_bits(result, test::collide(other)));
    }
    // Taken for the same hulls, with fewer features.
    other.a.radius = one.a.radius;
    other.b.radius = one.b.radius;
    cache = foreign;
    cache.first += 1000;
    cache.second += 1000;
    EXPECT_EQ(query_pair(other, cache).kind, CachedKind::Empty);
    cache.first = -1;
    EXPECT_EQ(query_pair(other, cache).kind, CachedKind::Empty);
  }
}

TEST(PairCache, APoseThatIsNotFiniteTouchesNothing) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double broken : {kNan, kInfinity, -kInfinity}) {
    for (int part = 0; part < 7; ++part) {
      for (const PairCase<double>& sound :
           {resting<double>(), test::crossed_edges(1, 0.01), test::crossed_edges(1, -0.01)}) {
        PairCache<double> cache;
        collide(sound, cache);
        PairCase<double> pair = sound;
        if (part < 3) pair.pose_b.position[part] = broken;
        if (part >= 3) pair.pose_b.rotation.coeffs()[part - 3] = broken;
        const CacheAnswer<double> answer = query_pair(pair, cache);
        EXPECT_FALSE(answer.hit && answer.kind == CachedKind::Features);
        collide(pair, cache);
        // The state is forgotten as soon as the pair is finite again.
        EXPECT_EQ(collide(sound, cache).points.size(), test::collide(sound).points.size());
      }
    }
  }
}

}  // namespace
}  // namespace contactscope
