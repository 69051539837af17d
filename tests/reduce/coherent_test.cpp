#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "reduce/brute_force.h"
#include "reduce/reducer.h"
#include "reduce/sliding_patch.h"

namespace contactscope {
namespace {

using test::Place;
using test::Slide;
using testing::ElementsAre;

template <class S>
std::vector<int> reduced(const ReducerInfo* reducer, const std::vector<ContactPoint<S>>& points,
                         const Vec3<S>& normal, int most, const std::vector<FeatureId>& previous) {
  ReduceOptions options;
  options.max_points = most;
  options.previous = previous;
  const KeptIndices kept = reduce<S>(reducer, points, normal, options);
  return {kept.begin(), kept.end()};
}

template <class S>
std::vector<FeatureId> ids_of(const std::vector<ContactPoint<S>>& points,
                              const std::vector<int>& kept) {
  std::vector<FeatureId> ids;
  for (const int i : kept) ids.push_back(points[static_cast<std::size_t>(i)].id);
  return ids;
}

/// Number of ids that are new.
int new_ids(const std::vector<FeatureId>& before, const std::vector<FeatureId>& now) {
  int count = 0;
  for (const FeatureId& id : now) {
    count += static_cast<int>(std::ranges::count(before, id) == 0);
  }
  return count;
}

/// The promises of reduce_coherently(), computed by trying every choice.
struct Promise {
  double reference;  // area
  double best;       // area of any choice
  double slack;      // of the separation
  double deepest;
};

template <class S> double separation(const std::vector<ContactPoint<S>>& points, int i) {
  return static_cast<double>(points[static_cast<std::size_t>(i)].separation);
}

template <class S>
double deepest_of(const std::vector<ContactPoint<S>>& points, const std::vector<int>& kept) {
  double deepest = std::numeric_limits<double>::infinity();
  for (const int i : kept) deepest = std::min(deepest, separation(points, i));
  return deepest;
}

template <class S>
Promise promise_of(const std::vector<ContactPoint<S>>& points, const std::vector<Place>& places,
                   int most) {
  Promise promise;
  std::vector<int> all;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) all.push_back(i);
  promise.deepest = deepest_of(points, all);
  promise.best = test::largest_area(places, most);
  promise.slack = std::max(0.002 * std::sqrt(promise.best), 0.05 * std::abs(promise.deepest));
  // Slightly less than half, so that rounding cannot admit what the reducer excludes.
  promise.reference = test::largest_area(places, most, [&](const std::vector<int>& chosen) {
    return deepest_of(points, chosen) <= promise.deepest + 0.4999 * promise.slack;
  });
  return promise;
}

template <class S>
void expect_kept(const Promise& promise, const std::vector<ContactPoint<S>>& points,
                 const std::vector<Place>& places, const std::vector<int>& kept, int most) {
  const double rounding = test::area_rounding(points, places);
  const double area = test::hull_area(test::at(places, kept));
  EXPECT_GE(area, 0.95 * promise.reference - rounding);
  EXPECT_GE(area, 0.95 * (1 - 2.0 / most) * promise.best - rounding);
  EXPECT_LE(deepest_of(points, kept), promise.deepest + 1.0001 * promise.slack);
}

template <class S> class CoherentReducer : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(CoherentReducer, Scalars);

TYPED_TEST(CoherentReducer, SlowBoundsAreaAndDepthInEveryFrameOfAnyMotion) {
  using S = TypeParam;
  test::Random random(31);
  int frames = 0;
  int kept_frames = 0;
  for (int motion = 0; motion < 40; ++motion) {
    const Slide slide = test::random_slide(random);
    const int most = motion % 4 == 3 ? 3 + random.index(4) : 4;
    std::vector<FeatureId> previous;
    for (int frame = 0; frame < 100; ++frame) {
      const auto points = test::patch_at<S>(slide, 0.05 * frame, 1e-4, random);
      if (static_cast<int>(points.size()) <= most || points.size() > 12) continue;
      const std::vector<int> kept =
          reduced<S>(find_reducer("coherent"), points, Vec3<S>::UnitZ(), most, previous);
      const std::vector<Place> places = test::seen_along<S>(points, Vec3<S>::UnitZ());
      expect_kept(promise_of(points, places, most), points, places, kept, most);
      const std::vector<FeatureId> ids = ids_of(points, kept);
      ++frames;
      kept_frames += static_cast<int>(ids == previous);
      previous = ids;
      if (testing::Test::HasFailure()) FAIL() << "motion " << motion << ", frame " << frame;
    }
  }
  EXPECT_GT(frames, 1000);
  EXPECT_GT(kept_frames, frames / 2);
}

// With 16 to 64 points, the reference is the best choice through any point that is deep enough.
TYPED_TEST(CoherentReducer, SlowBoundsAreaAndDepthOfManyPoints) {
  using S = TypeParam;
  test::Random random(35);
  for (const int count : {16, 24, 40, 64}) {
    for (int i = 0; i < 3; ++i) {
      std::vector<ContactPoint<S>> points;
      for (const Place& place : test::crowd(random, count, i)) {
        const auto edge = static_cast<std::uint32_t>(points.size());
        points.push_back({Vec3d(place.x, place.y, 0).cast<S>(), S(-0.1 * random.uniform(0.1, 0.9)),
                          FeatureId::of({Owner::A, edge}, {Owner::B, edge})});
      }
      const int deep = random.index(count);
      points[static_cast<std::size_t>(deep)].separation = S(-0.1);
      const std::vector<Place> places = test::seen_along<S>(points, Vec3<S>::UnitZ());
      // The slack is 5% of 0.1 m: the others are above it.
      const Promise promise = {test::largest_quadrilateral_with(places, deep),
                               test::largest_quadrilateral(places), 0.005, -0.1};
      std::vector<FeatureId> previous;
      for (int frame = 0; frame < 3; ++frame) {
        const std::vector<int> kept =
            reduced<S>(find_reducer("coherent"), points, Vec3<S>::UnitZ(), 4, previous);
        expect_kept(promise, points, places, kept, 4);
        previous = ids_of(points, kept);
        previous[static_cast<std::size_t>(frame)] = points[static_cast<std::size_t>(frame)].id;
      }
      ASSERT_FALSE(testing::Test::HasFailure()) << count << " points, case " << i;
    }
  }
}

TYPED_TEST(CoherentReducer, SlowBoundsAreaAndDepthForAnyPreviousPoints) {
  using S = TypeParam;
  test::Random random(32);
  for (const test::Shape shape : test::kShapes) {
    for (int i = 0; i < 200; ++i) {
      const int count = 5 + random.index(5);
      auto patch = test::random_patch<S>(random, shape, count);
      if (random.chance(0.3)) {
        patch.points[static_cast<std::size_t>(random.index(count))].separation *= S(2);
      }
      if (random.chance(0.3)) {  // duplicate ids
        for (auto& point : patch.points) {
          point.id.first.index %= 3;
          point.id.second.index %= 3;
        }
      }
      std::vector<FeatureId> previous;
      for (int k = random.index(6); k > 0; --k) {
        const auto edge = static_cast<std::uint32_t>(random.index(count + 2));
        previous.push_back(FeatureId::of({Owner::A, edge}, {Owner::B, edge}));
      }
      const std::vector<Place> places = test::seen_along(patch.points, patch.normal);
      const double rounding = test::area_rounding(patch.points, places);
      for (int most = 3; most <= 6; ++most) {
        if (count <= most) continue;
        const std::vector<int> kept =
            reduced<S>(find_reducer("coherent"), patch.points, patch.normal, most, previous);
        ASSERT_EQ(std::set<int>(kept.begin(), kept.end()).size(), kept.size()) << "an index twice";
        ASSERT_LE(static_cast<int>(kept.size()), most);
        const Promise promise = promise_of(patch.points, places, most);
        if (promise.best < 2 * rounding) continue;  // a line, see below
        expect_kept(promise, patch.points, places, kept, most);
        ASSERT_FALSE(testing::Test::HasFailure())
            << "shape " << static_cast<int>(shape) << ", case " << i << ", most " << most;
      }
    }
  }
}

TYPED_TEST(CoherentReducer, WithoutHistoryIsOptimalOnALevelPatch) {
  using S = TypeParam;
  test::Random random(33);
  for (int i = 0; i < 200; ++i) {
    auto patch = test::random_patch<S>(random, test::Shape::Shuffled, 6 + random.index(10));
    for (auto& point : patch.points) point.separation = patch.points[0].separation;
    for (const int most : {2, 3, 4, 5, 12}) {
      if (static_cast<int>(patch.points.size()) <= most) continue;
      EXPECT_EQ(reduced<S>(find_reducer("coherent"), patch.points, patch.normal, most, {}),
                reduced<S>(find_reducer("optimal"), patch.points, patch.normal, most, {}));
    }
  }
}

TYPED_TEST(CoherentReducer, NoiseChangesNoIdAtRest) {
  using S = TypeParam;
  test::Random random(34);
  int changed_by_optimal = 0;
  for (int motion = 0; motion < 30; ++motion) {
    Slide slide = test::random_slide(random);
    // Regular octagons too: many choices are equally good.
    if (motion < 10) slide = {4, 4, 0.2, 0, 0, 0};
    const double time = motion < 10 ? (std::numbers::pi / 4 - 0.2) / 0.2 : random.uniform(0, 10);
    std::vector<FeatureId> kept_before;
    std::vector<FeatureId> optimal_before;
    for (int frame = 0; frame < 300; ++frame) {
      const auto points = test::patch_at<S>(slide, time, 2e-4, random);
      if (points.size() <= 4) break;
      const auto ids = ids_of(
          points, reduced<S>(find_reducer("coherent"), points, Vec3<S>::UnitZ(), 4, kept_before));
      const auto optimal = ids_of(
          points, reduced<S>(find_reducer("optimal_deepest"), points, Vec3<S>::UnitZ(), 4, {}));
      if (frame > 0) {
        ASSERT_EQ(ids, kept_before) << "motion " << motion << ", frame " << frame;
        changed_by_optimal += new_ids(optimal_before, optimal);
      }
      kept_before = ids;
      optimal_before = optimal;
    }
  }
  EXPECT_GT(changed_by_optimal, 1000) << "the noise would be no trial";
}

TYPED_TEST(CoherentReducer, GivesUpFewerPointsOverMotionsThanOthers) {
  using S = TypeParam;
  // Counts points that exist but are no longer kept; vanished points are not the reducer's fault.
  constexpr const char* kNames[] = {"coherent", "area", "optimal", "optimal_deepest"};
  int given_up[4] = {};
  test::Random random(35);
  for (int motion = 0; motion < 60; ++motion) {
    const Slide slide = test::random_slide(random);
    std::vector<FeatureId> kept_before[4];
    for (int frame = 0; frame < 300; ++frame) {
      const auto points = test::patch_at<S>(slide, frame / 60.0, 1e-5, random);
      for (int r = 0; r < 4; ++r) {
        std::vector<FeatureId>& before = kept_before[r];
        const auto now = ids_of(
            points, reduced<S>(find_reducer(kNames[r]), points, Vec3<S>::UnitZ(), 4, before));
        for (const auto& point : points) {
          given_up[r] += static_cast<int>(std::ranges::count(before, point.id) > 0 &&
                                          std::ranges::count(now, point.id) == 0);
        }
        before = now;
      }
    }
  }
  for (int r = 0; r < 4; ++r) testing::Test::RecordProperty(kNames[r], given_up[r]);
  EXPECT_LT(2 * given_up[0], given_up[1]);
  EXPECT_LT(2 * given_up[0], given_up[2]);
  EXPECT_LT(2 * given_up[0], given_up[3]);
}

TYPED_TEST(CoherentReducer, SlowKeepsAsManyOldIdsAsTheBoundsAllow) {
  using S = TypeParam;
  test::Random random(36);
  int chosen_again = 0;
  for (int i = 0; i < 1500; ++i) {
    const int count = 6 + random.index(5);
    const auto patch = test::random_patch<S>(random, test::Shape::Polygon, count);
    std::vector<FeatureId> previous;
    std::vector<int> old;
    for (int k = 0; k < count && old.size() < 4; ++k) {
      if (!random.chance(0.5)) continue;
      old.push_back(k);
      previous.push_back(patch.points[static_cast<std::size_t>(k)].id);
    }
    if (random.chance(0.5)) previous.push_back(FeatureId::of({Owner::A, 99}, {Owner::B, 99}));
    const std::vector<int> kept =
        reduced<S>(find_reducer("coherent"), patch.points, patch.normal, 4, previous);
    if (kept == old) continue;
    ++chosen_again;
    const std::vector<Place> places = test::seen_along(patch.points, patch.normal);
    const Promise promise = promise_of(patch.points, places, 4);
    const auto count_old = [&](const std::vector<int>& chosen) {
      return static_cast<int>(std::ranges::count_if(
          chosen, [&](int point) { return std::ranges::count(old, point) > 0; }));
    };
    const int kept_old = count_old(kept);
    const double rounding = test::area_rounding(patch.points, places);
    const double more = test::largest_area(places, 4, [&](const std::vector<int>& chosen) {
      return count_old(chosen) > kept_old &&
             deepest_of(patch.points, chosen) <= promise.deepest + 0.4999 * promise.slack;
    });
    ASSERT_LT(more, 0.975 * promise.reference + rounding) << "case " << i;
    // Among choices with as many old ids, it is the largest. Old points come first, in their order.
    const double largest = test::largest_area(places, 4, [&](const std::vector<int>& chosen) {
      return count_old(chosen) == kept_old &&
             deepest_of(patch.points, chosen) <= promise.deepest + 0.4999 * promise.slack;
    });
    if (kept_old > 0) {
      ASSERT_GE(test::hull_area(test::at(places, kept)), largest - rounding) << "case " << i;
    }
    const auto first_new = kept.begin() + kept_old;
    if (largest < promise.reference - rounding) {
      ASSERT_EQ(count_old({kept.begin(), first_new}), kept_old);
      ASSERT_TRUE(std::is_sorted(kept.begin(), first_new));
    }
  }
  EXPECT_GT(chosen_again, 300);
}

/// Points in the x-y plane, z up, with these separations and different ids.
template <class S>
std::vector<ContactPoint<S>> points_at(const std::vector<Place>& places,
                                       const std::vector<double>& separations) {
  std::vector<ContactPoint<S>> points;
  for (const Place& place : places) {
    const auto edge = static_cast<std::uint32_t>(points.size());
    points.push_back({Vec3d(place.x, place.y, 0).cast<S>(),
                      static_cast<S>(separations[points.size()]),
                      FeatureId::of({Owner::A, edge}, {Owner::B, edge})});
  }
  return points;
}

TYPED_TEST(CoherentReducer, DropsOldPointsIfTheDeepestIsNotAmongThem) {
  using S = TypeParam;
  const std::vector<Place> hexagon = {{2, 0}, {1, 1.7}, {-1, 1.7}, {-2, 0}, {-1, -1.7}, {1, -1.7}};
  const Vec3<S> up = Vec3<S>::UnitZ();
  const auto level = points_at<S>(hexagon, {-0.01, -0.01, -0.01, -0.01, -0.01, -0.01});
  const std::vector<int> old = {1, 2, 4, 5};
  EXPECT_EQ(reduced<S>(find_reducer("coherent"), level, up, 4, ids_of(level, old)), old);
  // A little deeper: all stay. Much deeper: it enters, and as many as possible stay.
  const auto tilted = points_at<S>(hexagon, {-0.013, -0.01, -0.01, -0.007, -0.01, -0.01});
  EXPECT_EQ(reduced<S>(find_reducer("coherent"), tilted, up, 4, ids_of(tilted, old)), old);
  const auto steep = points_at<S>(hexagon, {-0.05, -0.01, -0.01, 0.03, -0.01, -0.01});
  const std::vector<int> kept =
      reduced<S>(find_reducer("coherent"), steep, up, 4, ids_of(steep, old));
  EXPECT_EQ(kept.size(), 4U);
  EXPECT_EQ(kept.back(), 0);
}

// As in a patch on several triangles of a mesh. The kept four are within the tolerance of the
// largest choice, which is the other four.
TYPED_TEST(CoherentReducer, DistinguishesPointsOfOneIdByOrder) {
  using S = TypeParam;
  const auto points = points_at<S>({{1, 1},
                                    {0.99, 0.99},
                                    {-1, 1},
                                    {-0.99, 0.99},
                                    {-1, -1},
                                    {-0.99, -0.99},
                                    {1, -1},
                                    {0.99, -0.99}},
                                   std::vector<double>(8, -0.01));
  const std::vector<int> old = {1, 3, 5, 7};
  for (const int twin : {3, 5, 7}) {
    auto doubled = points;
    doubled[static_cast<std::size_t>(twin)].id = doubled[1].id;
    EXPECT_EQ(
        reduced<S>(find_reducer("coherent"), doubled, Vec3<S>::UnitZ(), 4, ids_of(doubled, old)),
        old)
        << twin;
  }
}

TYPED_TEST(CoherentReducer, KeepsTheExtremesOfALineWhileTheyAreNearlyExtreme) {
  using S = TypeParam;
  const Vec3<S> up = Vec3<S>::UnitZ();
  const std::vector<double> level(6, -0.01);
  const auto line = [&](double end) {
    return points_at<S>({{0, 0}, {1, 2}, {0.2, 0.4}, {0.5, 1}, {end, 2 * end}, {0.7, 1.4}}, level);
  };
  const auto old = ids_of(line(0.99), {1, 0});
  for (const int most : {2, 4}) {
    EXPECT_THAT(reduced<S>(find_reducer("coherent"), line(0.99), up, most, old), ElementsAre(1, 0));
    EXPECT_THAT(reduced<S>(find_reducer("coherent"), line(1.04), up, most, old), ElementsAre(1, 0));
    EXPECT_THAT(reduced<S>(find_reducer("coherent"), line(1.08), up, most, old), ElementsAre(0, 4));
  }
}

TYPED_TEST(CoherentReducer, OneAloneStaysWhileItIsNearlyTheDeepest) {
  using S = TypeParam;
  const Vec3<S> up = Vec3<S>::UnitZ();
  const std::vector<Place> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto level = points_at<S>(square, {-0.01, -0.0101, -0.01, -0.01});
  EXPECT_THAT(reduced<S>(find_reducer("coherent"), level, up, 1, {}), ElementsAre(1));
  EXPECT_THAT(reduced<S>(find_reducer("coherent"), level, up, 1, ids_of(level, {3})),
              ElementsAre(3));
  const auto tilted = points_at<S>(square, {-0.01, -0.02, -0.01, -0.01});
  EXPECT_THAT(reduced<S>(find_reducer("coherent"), tilted, up, 1, ids_of(tilted, {3})),
              ElementsAre(1));
}

}  // namespace
}  // namespace contactscope
