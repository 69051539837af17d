#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reduce/plane_points.h"
#include "reduce/reducer.h"
#include "support/contact_polygons.h"

// Selections of the reimplemented engines, compared with independent measurements of the engines.
namespace contactscope {
namespace {

constexpr int kPolygons = 2000;

struct Kept {
  double area = 0;     // mean share of the best four-point area
  double deepest = 0;  // percent of polygons
  double worst = 1;    // smallest share
};

Kept measure(const std::string& name, int count) {
  const auto reducer = find_reducer(name);
  test::Random random(static_cast<std::uint64_t>(count));
  Kept mean;
  int deepest_kept = 0;
  for (int i = 0; i < kPolygons; ++i) {
    const test::ContactPolygon polygon = test::random_contact_polygon(random, count);
    const KeptIndices kept = reduce<double>(reducer, polygon.points, polygon.normal, {});
    std::vector<Vec3d> all;
    for (const auto& point : polygon.points) all.push_back(point.position);
    std::vector<Vec3d> chosen;
    for (const int k : kept) chosen.push_back(all[static_cast<std::size_t>(k)]);
    const auto deepest =
        std::ranges::min_element(polygon.points, {}, &ContactPoint<double>::separation);
    const auto index = static_cast<int>(deepest - polygon.points.begin());
    const double share =
        convex_area(chosen, polygon.normal) / best_convex_area(all, polygon.normal, 4);
    mean.area += share / kPolygons;
    mean.worst = std::min(mean.worst, share);
    if (std::ranges::find(kept, index) != kept.end()) ++deepest_kept;
  }
  mean.deepest = 100.0 * deepest_kept / kPolygons;
  return mean;
}

struct Measured {
  const char* name;
  std::array<Kept, 2> engine;  // for 8 and 16 points
};

// The engines over 2000 elliptical polygons of coplanar points, on one EPYC core.
constexpr Measured kMeasured[] = {
    {"box3d", {{{0.960, 65}, {0.943, 35}}}},
    {"box3d_mesh", {{{0.971, 68}, {0.976, 37}}}},
    {"jolt", {{{0.916, 76}, {0.934, 46}}}},
    {"bullet", {{{0.929, 100}, {0.809, 100}}}},
    {"ode", {{{0.943, 100}, {0.941, 100}}}},
    {"physx", {{{0.938, 100}, {0.950, 100}}}},
    {"physx_cluster", {{{0.854, 100}, {0.756, 100}}}},
    {"newton", {{{0.968, 67}, {0.976, 37}}}},
    {"mjx", {{{0.828, 62}, {0.828, 38}}}},
};

// The engines ran on other polygons, and a description is less than a program. These polygons were
// chosen so that the means agree (contact_polygons.h). On those of the reducers' study, which were
// not, the bands are 0.08 and 13 (tests/study). The largest differences: 0.023 in area
// (physx_cluster at 16), 3.95 percent of polygons (jolt at 16). One measurement cannot be
// reproduced from the description (PhysxFromItsDescription...): PhysX's batch reportedly falls to
// 0.04 of the best area.
constexpr double kAreaBand = 0.03;
constexpr double kDeepestBand = 5;

class EngineBand : public testing::TestWithParam<Measured> {};

TEST_P(EngineBand, KeepsTheAreaAndTheDeepestPointAsOftenAsTheEngine) {
  for (const int count : {8, 16}) {
    SCOPED_TRACE(count);
    const Kept& engine = GetParam().engine[count == 8 ? 0 : 1];
    const Kept ours = measure(GetParam().name, count);
    RecordProperty("area_" + std::to_string(count), std::to_string(ours.area));
    RecordProperty("deepest_" + std::to_string(count), std::to_string(ours.deepest));
    EXPECT_NEAR(ours.area, engine.area, kAreaBand);
    // An engine that protects the deepest point always does so.
    EXPECT_NEAR(ours.deepest, engine.deepest, engine.deepest == 100 ? 0 : kDeepestBand);
  }
}

INSTANTIATE_TEST_SUITE_P(Listed, EngineBand, testing::ValuesIn(kMeasured),
                         [](const auto& listed) { return std::string(listed.param.name); });

double share_kept(const std::string& name, const std::vector<ContactPoint<double>>& points) {
  const Vec3d normal = Vec3d::UnitY();
  std::vector<Vec3d> all;
  for (const ContactPoint<double>& point : points) all.push_back(point.position);
  std::vector<Vec3d> chosen;
  for (const int k : reduce<double>(find_reducer(name), points, normal, {})) {
    chosen.push_back(all[static_cast<std::size_t>(k)]);
  }
  return convex_area(chosen, normal) / best_convex_area(all, normal, 4);
}

// Let d be the distance from the deepest point to the farthest, and h the height of the patch
// across the line through both. The kept points span at least d h / 2, two triangles on the line.
// All points are within d of the deepest, so in a box of 2 d by h. So at least a quarter is kept.
TEST(EngineBand, PhysxFromItsDescriptionKeepsAQuarterOfAnyPatch) {
  EXPECT_GT(measure("physx", 8).worst, 0.4);
  EXPECT_GT(measure("physx", 16).worst, 0.4);
  test::Random random(41);
  double worst = 1;
  for (int i = 0; i < 20000; ++i) {
    // Long and flat on one side, or points anywhere in a long strip, the deepest anywhere.
    const double flat = random.decade(-3, 0);
    const double one_sided = random.chance(0.5) ? 0.02 : 1;
    const bool is_strip = random.chance(0.3);
    std::vector<test::PlanePoint> places;
    for (int k = 5 + random.index(6); k > 0; --k) {
      const double angle = random.uniform(0, 6.28);
      const double x = is_strip ? random.uniform(-1, 1) : std::cos(angle);
      const double z = is_strip ? random.uniform(-1, 1) : std::sin(angle);
      places.push_back({x, flat * (z < 0 ? one_sided * z : z), random.uniform(0, 1)});
    }
    worst = std::min(worst, share_kept("physx", test::points_at(places)));
  }
  EXPECT_GE(worst, 0.25);
  EXPECT_LT(worst, 0.35);
  // The deepest in the middle of a strip, the outermost points just beyond its corners: a quarter.
  EXPECT_NEAR(share_kept("physx", test::points_at({{0, 0, 1},
                                                   {1, 0},
                                                   {0.5, 0.01},
                                                   {0.5, -0.01},
                                                   {0.999, 0.00999},
                                                   {-0.999, 0.00999},
                                                   {-0.999, -0.00999},
                                                   {0.999, -0.00999}})),
              0.25, 0.002);
  EXPECT_LT(measure("physx_cluster", 8).worst, 0.3);  // has no such bound
}

TEST(EngineBand, IsNotMetByAnyChoice) {
  for (const char* name : {"first", "random", "deepest"}) {
    const Kept kept = measure(name, 8);
    for (const Measured& engine : kMeasured) {
      EXPECT_GT(std::abs(kept.area - engine.engine[0].area), 5 * kAreaBand) << name;
    }
  }
}

TEST(EngineBand, TheTalksStepsKeepAsMuchAsBox3d) {
  EXPECT_NEAR(measure("area", 8).area, 0.960, kAreaBand);
  EXPECT_NEAR(measure("area", 16).area, 0.943, kAreaBand);
  EXPECT_NEAR(measure("area_deepest", 8).area, 0.960, kAreaBand);
  EXPECT_EQ(measure("area_deepest", 16).deepest, 100);
}

}  // namespace
}  // namespace contactscope
