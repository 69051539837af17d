#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "reduce/brute_force.h"
#include "reduce/reducer.h"
#include "support/cases.h"

// Points of a level patch have equal depths up to rounding: none of them is the deepest, and area
// decides. The oracle is every choice of points, in double (brute_force.h).
namespace contactscope {
namespace {

using test::Place;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

/// The overlap of a box's face, turned and moved, with a face of half extents 1 and `flat`.
std::vector<Place> overlap_of_faces(test::Random& random, double flat) {
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  const double c = std::cos(angle), s = std::sin(angle);
  const bool same = random.chance(0.5);
  const double x = same ? 0 : random.uniform(-0.5, 0.5), y = same ? 0 : random.uniform(-0.5, 0.5);
  const double a = same ? 1 : random.uniform(0.4, 1.5), b = same ? flat : random.uniform(0.4, 1.5);
  std::vector<Place> polygon;
  for (const auto& [u, v] : {std::pair{-a, -b}, {a, -b}, {a, b}, {-a, b}})
    polygon.push_back({x + c * u - s * v, y + s * u + c * v});
  for (const auto& [nx, ny, reach] :
       {std::tuple{1.0, 0.0, 1.0}, {-1.0, 0.0, 1.0}, {0.0, 1.0, flat}, {0.0, -1.0, flat}}) {
    std::vector<Place> left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Place& p = polygon[i];
      const Place& q = polygon[(i + 1) % polygon.size()];
      const double of_p = nx * p.x + ny * p.y - reach, of_q = nx * q.x + ny * q.y - reach;
      if (of_p <= 0) left.push_back(p);
      if ((of_p < 0 && of_q > 0) || (of_p > 0 && of_q < 0)) {
        const double t = of_p / (of_p - of_q);
        left.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
      }
    }
    polygon = left;
  }
  return polygon;
}

/// The overlap of two boxes' faces, a polygon on an ellipse, or a regular one; five points or more.
std::vector<Place> level_patch(test::Random& random, int kind) {
  if (kind == 0) {
    for (;;) {
      const std::vector<Place> places = overlap_of_faces(random, random.uniform(0.3, 1));
      if (places.size() > 4) return places;
    }
  }
  const int count = 5 + random.index(kind == 1 ? 8 : 4);
  const double flat = kind == 1 ? random.uniform(0.3, 1) : 1;
  const double begin = random.uniform(0, 2 * std::numbers::pi);
  std::vector<Place> places;
  for (int i = 0; i < count; ++i) {
    const double angle =
        begin + 2 * std::numbers::pi * (i + (kind == 1 ? random.uniform(0, 0.9) : 0)) / count;
    places.push_back({std::cos(angle), flat * std::sin(angle)});
  }
  return places;
}

template <class S> struct LevelPatch {
  std::vector<ContactPoint<S>> points;
  Vec3<S> normal;
  ReduceOptions options;

  /// Gives all points one depth up to a few roundings; `shallow` ones are a thousandth less deep.
  void lay(test::Random& random, const std::vector<bool>& shallow = {}) {
    const double rounding = std::numeric_limits<S>::epsilon() * options.scale;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool is_deep = shallow.empty() || !shallow[i];
      points[i].separation = static_cast<S>((is_deep ? -0.02 : -0.019) * options.scale +
                                            rounding * random.uniform(-3, 3));
    }
  }
};

/// Places the patch anywhere, 1e-4 to 1e4 metres in size. All ids differ and are unordered.
template <class S> LevelPatch<S> place(test::Random& random, const std::vector<Place>& places) {
  LevelPatch<S> patch;
  const double size = random.decade(-4, 4);
  patch.options.scale = 4 * size;
  const Pose<double> pose = random.pose(size);
  patch.normal = pose.rotate(Vec3d::UnitZ()).template cast<S>();
  const auto stride = static_cast<std::uint32_t>(2 * random.index(8) + 17);  // prime to the count
  for (const Place& at : places) {
    const auto edge = static_cast<std::uint32_t>(patch.points.size()) * stride % 1009;
    patch.points.push_back({pose.transform(Vec3d(size * at.x, size * at.y, 0)).template cast<S>(),
                            S(0), FeatureId::of({Owner::A, edge}, {Owner::B, edge})});
  }
  return patch;
}

template <class S> std::vector<int> reduced(const char* name, const LevelPatch<S>& patch) {
  const KeptIndices kept = reduce<S>(find_reducer(name), patch.points, patch.normal, patch.options);
  return {kept.begin(), kept.end()};
}

template <class S>
std::set<FeatureId> ids_of(const LevelPatch<S>& patch, const std::vector<int>& kept) {
  std::set<FeatureId> ids;
  for (const int i : kept) ids.insert(patch.points[static_cast<std::size_t>(i)].id);
  return ids;
}

/// Area spanned by the points of `ids`, in units of the patch's size, from coordinates that are not
/// rounded to S. Point k of `patch` is at flat[k].
template <class S>
double area_before_rounding(const std::vector<Place>& flat, const LevelPatch<S>& patch,
                            const std::set<FeatureId>& ids) {
  std::vector<Place> kept;
  for (std::size_t k = 0; k < flat.size(); ++k)
    if (ids.contains(patch.points[k].id)) kept.push_back(flat[k]);
  return test::hull_area(kept);
}

template <class S> class DepthTies : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(DepthTies, Scalars);

const int kPatches = test::cases(3'000);

// Rounding noise in depths, another order of the points and another place change no choice.
TYPED_TEST(DepthTies, SlowTheLargestAreaIsKeptAndNoRoundingChangesIt) {
  using S = TypeParam;
  test::Random random(51);
  double of_steps = 0, least = 1;
  int swapped = 0;
  for (int i = 0; i < kPatches; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const std::vector<Place> flat = level_patch(random, i % 3);
    LevelPatch<S> patch = place<S>(random, flat);
    patch.lay(random);
    const std::vector<Place> places = test::seen_along(patch.points, patch.normal);
    const double largest = test::largest_area(places, 4);
    const double rounding = test::area_rounding(patch.points, places);
    for (const char* name : {"optimal_deepest", "optimal", "coherent"})
      ASSERT_NEAR(test::hull_area(test::at(places, reduced(name, patch))), largest, rounding)
          << name;
    const double share =
        test::hull_area(test::at(places, reduced("area_deepest", patch))) / largest;
    of_steps += share;
    least = std::min(least, share);

    LevelPatch<S> other = patch;
    other.lay(random);
    for (const char* name : {"optimal_deepest", "area_deepest", "coherent"})
      ASSERT_EQ(ids_of(other, reduced(name, other)), ids_of(patch, reduced(name, patch))) << name;
    LevelPatch<S> moved = place<S>(random, flat);
    moved.lay(random);
    for (std::size_t k = 0; k < moved.points.size(); ++k) moved.points[k].id = patch.points[k].id;
    if (i % 6 < 3) std::ranges::reverse(moved.points);
    // Another place rounds the coordinates differently. If two areas differ by about that rounding,
    // either choice is right. If they are equal before rounding, the choice must not change.
    const std::set<FeatureId> ids = ids_of(patch, reduced("optimal_deepest", patch));
    const std::set<FeatureId> moved_ids = ids_of(moved, reduced("optimal_deepest", moved));
    if (moved_ids == ids) continue;
    ++swapped;
    const double difference = std::abs(area_before_rounding(flat, patch, moved_ids) -
                                       area_before_rounding(flat, patch, ids));
    const double size = patch.options.scale / 4;
    ASSERT_GT(difference, 64 * std::numeric_limits<double>::epsilon());
    ASSERT_LT(difference, rounding / (size * size));
  }
  EXPECT_LE(swapped, kPatches / 10'000);
  EXPECT_GT(of_steps / kPatches, 0.995);
  EXPECT_GT(least, 0.8);
}

TYPED_TEST(DepthTies, SlowTheLargestAreaBreaksATieOfDepths) {
  using S = TypeParam;
  test::Random random(52);
  for (int i = 0; i < kPatches; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    LevelPatch<S> patch = place<S>(random, level_patch(random, i % 3));
    std::vector<bool> shallow;
    for (std::size_t k = 0; k < patch.points.size(); ++k) shallow.push_back(random.chance(0.7));
    const auto deep = static_cast<std::size_t>(random.index(static_cast<int>(shallow.size())));
    shallow[deep] = false;
    patch.lay(random, shallow);
    const std::vector<Place> places = test::seen_along(patch.points, patch.normal);
    const double largest = test::largest_area(places, 4, [&](const std::vector<int>& chosen) {
      return std::ranges::any_of(chosen,
                                 [&](int k) { return !shallow[static_cast<std::size_t>(k)]; });
    });
    const std::vector<int> kept = reduced("optimal_deepest", patch);
    ASSERT_FALSE(shallow[static_cast<std::size_t>(kept[0])]);
    ASSERT_NEAR(test::hull_area(test::at(places, kept)), largest,
                test::area_rounding(patch.points, places));
  }
}

template <class S> LevelPatch<S> octagon() {
  LevelPatch<S> patch{{}, Vec3<S>::UnitZ(), {}};
  for (std::uint32_t i = 0; i < 8; ++i) {
    const double angle = 2 * std::numbers::pi * i / 8;
    patch.points.push_back({Vec3d(std::cos(angle), std::sin(angle), 0).cast<S>(), S(-0.01),
                            FeatureId::of({Owner::A, i}, {Owner::B, i})});
  }
  return patch;
}

TYPED_TEST(DepthTies, ATieOfAreasKeepsThePreviousFrame) {
  using S = TypeParam;
  LevelPatch<S> patch = octagon<S>();
  for (const char* name : {"optimal", "optimal_deepest", "area_deepest", "coherent"}) {
    patch.options.previous = {};
    EXPECT_THAT(reduced(name, patch), UnorderedElementsAre(0, 2, 4, 6)) << name;
    const std::vector<FeatureId> before = {patch.points[3].id, patch.points[5].id,
                                           patch.points[7].id, patch.points[1].id};
    patch.options.previous = before;
    EXPECT_THAT(reduced(name, patch), UnorderedElementsAre(1, 3, 5, 7)) << name;
  }
}

TYPED_TEST(DepthTies, APointDeeperByMoreThanRoundingIsTheDeepest) {
  using S = TypeParam;
  LevelPatch<S> patch = octagon<S>();
  patch.points[1].separation -= S(32) * std::numeric_limits<S>::epsilon();
  for (const char* name : {"optimal_deepest", "area_deepest", "deepest"})
    EXPECT_EQ(reduced(name, patch)[0], 1) << name;
  // For a pair with coordinates a hundred times as large, the difference is rounding.
  patch.options.scale = 100;
  for (const char* name : {"optimal_deepest", "area_deepest"})
    EXPECT_THAT(reduced(name, patch), UnorderedElementsAre(0, 2, 4, 6)) << name;
}

}  // namespace
}  // namespace contactscope
