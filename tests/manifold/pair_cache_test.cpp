#include "manifold/pair_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>

#include "manifold/dispatch.h"
#include "manifold/recorder.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"

namespace contactscope {
namespace {

using test::PairCase;
using test::Random;

template <class S>
bool same_bits(const Manifold<S>& one, const Manifold<S>& other) {
  if (one.axis != other.axis || one.type != other.type ||
      one.points.size() != other.points.size() ||
      std::memcmp(&one.normal, &other.normal, sizeof one.normal) != 0) {
    return false;
  }
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    const ContactPoint<S>& p = one.points[i];
    const ContactPoint<S>& q = other.points[i];
    if (p.position != q.position || p.separation != q.separation || p.id != q.id) return false;
  }
  return true;
}

/// A pair in motion: B's pose in frame k, from its pose in frame 0. `size` is the larger radius.
struct Motion {
  const char* name;
  std::function<Pose<double>(const Pose<double>& start, double size, int frame)> pose;
};

Pose<double> turned(const Pose<double>& pose, const Vec3d& axis, double angle) {
  return {(test::about(axis, angle) * pose.rotation).normalized(), pose.position};
}

/// Drawn anew for every pair.
std::vector<Motion> motions(Random& random, const Vec3d& normal) {
  const Vec3d axis = random.unit_vector();
  const Vec3d along = normal.cross(random.unit_vector()).normalized();
  const double seed = random.uniform(0, 6);
  return {
      {"rests, trembling",
       [=](const Pose<double>& start, double size, int k) {
         Pose<double> pose = turned(start, axis, 2e-4 * std::sin(5.1 * k + seed));
         pose.position += 1e-4 * size * std::sin(3.7 * k + seed) * along;
         return pose;
       }},
      {"slides",
       [=](const Pose<double>& start, double size, int k) {
         Pose<double> pose = turned(start, normal, 2e-3 * k);
         pose.position += 4e-3 * size * k * along;
         return pose;
       }},
      {"tumbles",
       [=](const Pose<double>& start, double, int k) { return turned(start, axis, 0.01 * k); }},
      {"leaves and comes back",
       [=](const Pose<double>& start, double size, int k) {
         Pose<double> pose = turned(start, axis, 0.1 * std::sin(0.03 * k));
         pose.position += 0.06 * size * std::sin(0.11 * k + seed) * normal;
         return pose;
       }},
  };
}

Hull<double> random_body(Random& random, double size) {
  if (random.chance(0.4)) return test::random_box(random, size, 4);
  const int vertices[] = {8, 16, 32, 64};
  return test::random_hull(random, vertices[random.index(4)], size, 3);
}

/// Two bodies whose overlap along the axis of least depth is 0 to 4% of their size, and that axis.
PairCase<double> touching_pair(Random& random, Vec3d& normal) {
  const double size = random.decade(-4, 4);
  PairCase<double> pair{random_body(random, size), {}, random_body(random, size), {}};
  pair.pose_b = {random.rotation(), 0.5 * size * random.unit_vector()};
  if (random.chance(0.3)) pair.pose_b.rotation = random.rotation_by(1e-3);
  const test::BruteForceAxis axis = test::brute_force_sat(pair.a, pair.pose_a, pair.b, pair.pose_b);
  pair.pose_b.position += (-random.uniform(0, 0.04) * size - axis.separation) * axis.normal;
  normal = axis.normal;
  return pair;
}

template <class S>
double best_separation(const PairCase<S>& pair) {
  const PairCase<double> exact = pair.template cast<double>();
  const HullPair<double> placed(exact.a, exact.b, relative_pose(exact.pose_a, exact.pose_b));
  const SatResult<double> axes = sat(placed, 0.0, Preference::None);
  return axes.separation(axes.status == SatStatus::Separated ? axes.chosen : axes.deepest);
}

template <class S>
class PairCacheMotion : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(PairCacheMotion, Scalars);

TYPED_TEST(PairCacheMotion, ResultsEqualThoseWithoutACacheUpToThePreference) {
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
    CollideOptions<S> options;
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
        NoRecorder<S> nobody;
        const CacheAnswer<S> answer =
            collide_from_cache(pair.a, pair.b, b_in_a, options, cache, tried, nobody);
        const Manifold<S> cached =
            collide_hull_hull(pair.a, pair.pose_a, pair.b, pair.pose_b, options, cache);
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

        // The axis is one that the preference takes, measured by the vertices alone.
        const PairCase<double> exact = pair.template cast<double>();
        const double along = test::separation_along(cached.normal.template cast<double>(), exact.a,
                                                    exact.pose_a, exact.b, exact.pose_b);
        const double smaller = std::min(exact.a.radius, exact.b.radius);
        const double preference =
            std::max(0.05 * std::max(-best, 0.0), 0.002 * smaller) + 2 * rounding;
        ASSERT_GE(along, best - preference);
        ASSERT_LE(test::deepest(cached), std::max(best, along) + preference);
        ASSERT_GE(test::deepest(cached), along - 2 * rounding);
        // The same axis makes the same manifold. Edges apart are measured by support points, of
        // which both ends of an edge are one.
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

template <class S>
PairCase<S> resting() {
  return test::stacked_cubes(0.4, 0.005).template cast<S>();
}

template <class S>
CacheAnswer<S> ask(const PairCase<S>& pair, const PairCache<S>& cache,
                   const CollideOptions<S>& options = {}) {
  Contact<S> contact;
  NoRecorder<S> nobody;
  return collide_from_cache(pair.a, pair.b, relative_pose(pair.pose_a, pair.pose_b), options, cache,
                            contact, nobody);
}

template <class S>
Manifold<S> collide(const PairCase<S>& pair, PairCache<S>& cache,
                    const CollideOptions<S>& options = {}) {
  return collide_hull_hull(pair.a, pair.pose_a, pair.b, pair.pose_b, options, cache);
}

TEST(PairCache, IsEmptyAtFirstAndHoldsTheFeaturesOfATouchingPair) {
  const PairCase<float> pair = resting<float>();
  PairCache<float> cache;
  EXPECT_FALSE(ask(pair, cache).hit);
  EXPECT_EQ(ask(pair, cache).kind, CachedKind::Empty);
  const Manifold<float> first = collide(pair, cache);
  EXPECT_EQ(cache.kind, CachedKind::Features);
  EXPECT_TRUE(ask(pair, cache).hit);
  EXPECT_TRUE(same_bits(first, collide(pair, cache)));
}

TEST(PairCache, BoxesAtRestMayMoveBySeveralPercentOfTheirSize) {
  PairCase<double> pair = resting<double>();
  PairCache<double> cache;
  collide(pair, cache);
  pair.pose_b.position.x() += 0.04;
  EXPECT_TRUE(ask(pair, cache).hit);
  EXPECT_NEAR(ask(pair, cache).moved, 0.04, 1e-12);
  pair.pose_b.position.x() += 0.4;
  EXPECT_FALSE(ask(pair, cache).hit);
  EXPECT_EQ(ask(pair, cache).kind, CachedKind::Features);
}

TEST(PairCache, NoPointOfOneHullSeenFromTheOtherMovesFartherThanIsSaid) {
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
    const CacheAnswer<double> answer = ask(pair, cache);
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

TEST(PairCache, ABoxThatSlidesOverTheRimIsPushedOutSideways) {
  // Far from the kept axis another one becomes shallower: the bound must notice, not the axis.
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
  const CacheAnswer<float> answer = ask(pair, cache);
  EXPECT_TRUE(answer.hit);
  EXPECT_NEAR(answer.separation, 0.095f, 1e-5f);
  pair.pose_b.position.y() -= 0.1f;
  EXPECT_FALSE(ask(pair, cache).hit);
  EXPECT_TRUE(same_bits(collide(pair, cache), test::collide(pair)));
  EXPECT_EQ(cache.kind, CachedKind::Features);
}

TEST(PairCache, TheCrossProductOfTheLastEdgesSeparatesToo) {
  PairCase<float> pair = test::crossed_edges(1, -0.02).cast<float>();
  PairCache<float> cache;
  EXPECT_TRUE(collide(pair, cache).points.empty());
  EXPECT_EQ(cache.axis, AxisKind::EdgeEdge);
  pair.pose_b.position += Vec3f(0.1f, -0.01f, 0.1f);
  EXPECT_TRUE(ask(pair, cache).hit);
  EXPECT_NEAR(ask(pair, cache).separation, 0.01f, 1e-5f);
}

TEST(PairCache, FeaturesThatHavePartedSeparateThePairAndAreStillThere) {
  PairCase<float> pair = resting<float>();
  PairCache<float> cache;
  const Manifold<float> before = collide(pair, cache);
  pair.pose_b.position.y() += 0.01f;
  const CacheAnswer<float> apart = ask(pair, cache);
  EXPECT_TRUE(apart.hit);
  EXPECT_EQ(apart.kind, CachedKind::SeparatingAxis);
  EXPECT_TRUE(collide(pair, cache).points.empty());
  pair.pose_b = resting<float>().pose_b;
  EXPECT_EQ(ask(pair, cache).kind, CachedKind::Features);
  EXPECT_TRUE(same_bits(before, collide(pair, cache)));
}

TEST(PairCache, WithoutAPreferenceOnlySeparatingAxesAreKept) {
  CollideOptions<double> options;
  options.preference = Preference::None;
  PairCase<double> pair = resting<double>();
  PairCache<double> cache;
  collide(pair, cache, options);
  EXPECT_EQ(cache.kind, CachedKind::Empty);
  pair.pose_b.position.y() += 0.1;
  collide(pair, cache, options);
  EXPECT_TRUE(ask(pair, cache, options).hit);
  // Nor are features used that were kept under another preference.
  pair = resting<double>();
  PairCache<double> preferring;
  collide(pair, preferring);
  EXPECT_TRUE(ask(pair, preferring).hit);
  EXPECT_FALSE(ask(pair, preferring, options).hit);
}

TEST(PairCache, OfAnotherPairDoesNoHarm) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const PairCase<float> one = test::random_pair(random).cast<float>();
    PairCase<float> other = test::random_pair(random).cast<float>();
    PairCache<float> cache;
    collide(one, cache);
    const PairCache<float> foreign = cache;
    if (other.a.radius != one.a.radius) {
      EXPECT_EQ(ask(other, foreign).kind, CachedKind::Empty);
      const Manifold<float> result = collide(other, cache);
      EXPECT_TRUE(same_bits(result, test::collide(other)));
    }
    // Taken for the same hulls, with fewer features.
    other.a.radius = one.a.radius;
    other.b.radius = one.b.radius;
    cache = foreign;
    cache.first += 1000;
    cache.second += 1000;
    EXPECT_EQ(ask(other, cache).kind, CachedKind::Empty);
    cache.first = -1;
    EXPECT_EQ(ask(other, cache).kind, CachedKind::Empty);
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
        const CacheAnswer<double> answer = ask(pair, cache);
        EXPECT_FALSE(answer.hit && answer.kind == CachedKind::Features);
        collide(pair, cache);
        // And is forgotten as soon as the pair is sound again.
        EXPECT_EQ(collide(sound, cache).points.size(), test::collide(sound).points.size());
      }
    }
  }
}

TEST(PairCache, TheSameHistoryGivesTheSameBitsWatchedOrNot) {
  Random random(77);
  for (int i = 0; i < 20; ++i) {
    Vec3d normal;
    const PairCase<double> start = touching_pair(random, normal);
    const Shape<float> a = hull_cast<float>(start.a);
    const Shape<float> b = hull_cast<float>(start.b);
    const double size = start.a.radius;
    CollideOptions<float> options;
    options.reducer = find_reducer<float>("area");
    for (const Motion& motion : motions(random, normal)) {
      PairCache<float> watched_cache, cache;
      for (int k = 0; k < 60; ++k) {
        const Pose<float> pose_a = start.pose_a.cast<float>();
        const Pose<float> pose_b = motion.pose(start.pose_b, size, k).cast<float>();
        Manifolds<float> watched, unwatched;
        trace::Pair record;
        collide(a, pose_a, b, pose_b, options, watched, Recording{"area", {}}, record,
                &watched_cache);
        collide(a, pose_a, b, pose_b, options, unwatched, &cache);
        ASSERT_EQ(watched.size(), unwatched.size());
        if (!watched.empty()) {
          ASSERT_TRUE(same_bits(watched[0], unwatched[0]));
        }

        // What the record says is what ran.
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

}  // namespace
}  // namespace contactscope
