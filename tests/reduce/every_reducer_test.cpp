#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reduce/reducer.h"
#include "support/random_geometry.h"

// Properties of every reducer, on easy and on hard input.
namespace contactscope {
namespace {

struct Case {
  std::string name;
  Vec3d normal = Vec3d::UnitY();
  std::vector<ContactPoint<double>> points;
};

void add(Case& c, const Vec3d& position, double separation) {
  const auto edge = static_cast<std::uint32_t>(c.points.size());
  c.points.push_back({position, separation, FeatureId::of({Owner::A, edge}, {Owner::B, edge})});
}

Case ellipse(const std::string& name, int count, double off_plane = 0) {
  Case c{name, Vec3d::UnitY(), {}};
  test::Random random(static_cast<std::uint64_t>(count));
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.uniform(-0.4, 0.4)) / count;
    add(c, Vec3d(std::cos(angle), random.uniform(-off_plane, off_plane), 0.6 * std::sin(angle)),
        -0.01 * random.uniform(0, 1));
  }
  return c;
}

Case line(const std::string& name, double noise) {
  Case c{name, Vec3d::UnitY(), {}};
  test::Random random(3);
  for (const double t : {0.3, -1.0, 0.0, 0.7, 1.0, -0.2, 0.1}) {
    add(c, Vec3d(t, 0, 2 * t + random.uniform(-noise, noise)), -0.001);
  }
  return c;
}

Case shuffled(Case c) {
  c.name = "ShuffledOrder";
  test::Random random(11);
  for (std::size_t i = c.points.size(); i > 1; --i) {
    std::swap(c.points[i - 1],
              c.points[static_cast<std::size_t>(random.index(static_cast<int>(i)))]);
  }
  return c;
}

Case moved(const std::string& name, Case c, double scale) {
  c.name = name;
  test::Random random(5);
  const Pose<double> pose = random.pose(5 * scale);
  c.normal = pose.rotation * c.normal;
  for (ContactPoint<double>& point : c.points) {
    point.position = pose.rotation * (scale * point.position) + pose.position;
    point.separation *= scale;
  }
  return c;
}

Case duplicates() {
  Case c{"EveryPointTwice", Vec3d::UnitY(), {}};
  for (int twice = 0; twice < 2; ++twice) {
    for (const ContactPoint<double>& point : ellipse("", 5).points) {
      add(c, point.position, point.separation);
    }
  }
  return c;
}

Case coincident() {
  Case c{"AllCoincident", Vec3d::UnitY(), {}};
  for (int i = 0; i < 7; ++i) add(c, Vec3d(1, 2, 3), -0.01);
  return c;
}

std::vector<Case> cases() {
  return {ellipse("Eight", 8),
          ellipse("Five", 5),
          ellipse("SixtyFour", 64),
          ellipse("OffThePlane", 12, 0.05),
          shuffled(ellipse("", 12)),
          moved("MovedAnywhere", ellipse("", 9), 1),
          moved("Tiny", ellipse("", 9), 1e-4),
          moved("Huge", ellipse("", 9), 1e4),
          moved("Overflowing", ellipse("", 9), 1e30),  // in float no area is finite
          line("OnALine", 0),
          line("NearlyOnALine", 1e-9),
          duplicates(),
          coincident(),
          ellipse("Two", 2),
          ellipse("None", 0)};
}

template <class S> std::vector<ContactPoint<S>> points_of(const Case& c) {
  std::vector<ContactPoint<S>> points;
  for (const ContactPoint<double>& point : c.points) {
    points.push_back({point.position.cast<S>(), static_cast<S>(point.separation), point.id});
  }
  return points;
}

std::vector<std::string> reducer_names() {
  std::vector<std::string> names;
  for (const ReducerInfo& info : reducers()) names.push_back(info.name);
  return names;
}

class EveryReducer : public testing::TestWithParam<std::string> {};

template <class S> void keeps_its_contract(const std::string& name, const Case& c, int max_points) {
  SCOPED_TRACE(c.name + ", max_points " + std::to_string(max_points));
  const std::vector<ContactPoint<S>> points = points_of<S>(c);
  const Vec3<S> normal = c.normal.cast<S>();
  ReduceOptions options;
  options.max_points = max_points;
  const ReducerInfo* reducer = find_reducer(name);
  const KeptIndices once = reduce<S>(reducer, points, normal, options);
  const KeptIndices again = reduce<S>(reducer, points, normal, options);
  EXPECT_TRUE(std::ranges::equal(once, again));

  const auto count = static_cast<int>(points.size());
  std::vector<int> kept(once.begin(), once.end());
  if (count <= max_points || reducer == nullptr) {
    EXPECT_EQ(static_cast<int>(kept.size()), count);
  } else {
    EXPECT_FALSE(kept.empty());
    EXPECT_LE(static_cast<int>(kept.size()), max_points);
  }
  std::ranges::sort(kept);
  EXPECT_TRUE(std::ranges::adjacent_find(kept) == kept.end()) << "an index twice";
  for (const int index : kept) {
    EXPECT_GE(index, 0);
    EXPECT_LT(index, count);
  }
}

TEST_P(EveryReducer, KeepsAtMostSoManyDifferentPointsAndAnswersTheSameTwice) {
  for (const Case& c : cases()) {
    for (const int max_points : {1, 2, 3, 4, 5, 8}) {
      keeps_its_contract<float>(GetParam(), c, max_points);
      keeps_its_contract<double>(GetParam(), c, max_points);
    }
  }
}

TEST_P(EveryReducer, RefusesWhatIsNotFinite) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const ReducerInfo* reducer = find_reducer(GetParam());
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (int field = 0; field < 5; ++field) {
      Case c = ellipse("", 9);
      if (field < 3) c.points[4].position[field] = bad;
      if (field == 3) c.points[8].separation = bad;
      if (field == 4) c.normal.z() = bad;
      const KeptIndices result = reduce<double>(reducer, c.points, c.normal, {});
      EXPECT_TRUE(result.empty()) << bad << " in field " << field;
    }
  }
}

TEST_P(EveryReducer, ChoosesTheSameOfAPatchAtEveryPowerOfTwo) {
  const Case c = moved("", ellipse("", 11), 1);
  const ReducerInfo* reducer = find_reducer(GetParam());
  const std::vector<ContactPoint<float>> points = points_of<float>(c);
  const Vec3<float> normal = c.normal.cast<float>();
  const KeptIndices expected = reduce<float>(reducer, points, normal, {});
  for (const float scale : {0x1p-20F, 0x1p-10F, 0x1p10F, 0x1p20F}) {
    std::vector<ContactPoint<float>> scaled = points;
    for (ContactPoint<float>& point : scaled) {
      point.position *= scale;
      point.separation *= scale;
    }
    EXPECT_TRUE(std::ranges::equal(reduce<float>(reducer, scaled, normal, {}), expected)) << scale;
  }
}

// Ties go to the earliest point, so that later points do not change a choice. (Engines' reducers
// behave like the engines, and `deepest` takes both.)
TEST(Reducers, TakeTheEarlierOfTwoPointsThatAreOne) {
  const Case c = duplicates();
  for (const char* const name :
       {"area", "area_deepest", "distance", "extremes", "optimal", "optimal_deepest", "coherent"}) {
    for (const int max_points : {1, 2, 3, 4}) {
      ReduceOptions options;
      options.max_points = max_points;
      for (const int index : reduce<double>(find_reducer(name), c.points, c.normal, options))
        EXPECT_LT(index, 5) << name << ", max_points " << max_points;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Listed, EveryReducer, testing::ValuesIn(reducer_names()),
                         [](const auto& listed) { return listed.param; });

}  // namespace
}  // namespace contactscope
