#include "reduce/steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "reduce/choices.h"
#include "support/random_geometry.h"

// All scores at once select the same points as the recorded reducer, which goes one by one.
namespace contactscope {
namespace {

using test::Random;

/// Five to eight random points in a plane, in metres; `kind` selects their distribution.
template <class S> std::vector<ContactPoint<S>> draw(Random& random, int kind, Vec3<S>& normal) {
  const Pose<double> pose = random.pose(random.chance(0.5) ? 1 : 1000);
  const double size = random.chance(0.5) ? 1 : random.decade(-4, 4);
  normal = pose.rotate(Vec3d::UnitZ()).template cast<S>();
  const int count = 5 + random.index(4);
  std::vector<ContactPoint<S>> points;
  for (int i = 0; i < count; ++i) {
    Vec3d at = Vec3d::Zero();
    const double angle = 2 * std::numbers::pi * i / count;
    if (kind == 0) at = {random.uniform(-1, 1), random.uniform(-1, 1), 0};
    if (kind == 1) at = {std::cos(angle), 0.5 * std::sin(angle), 0};
    if (kind == 2) at = {0.5 * random.index(3), 0.5 * random.index(3), 0};
    if (kind == 3) at = {random.uniform(-1, 1), 1e-7 * random.uniform(-1, 1), 0};
    if (kind == 4) at = {0.25 * random.index(3), 0, 0};
    if (kind == 5) at = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.1, 0.1)};
    const Vec3d placed = pose.transform(size * at);
    points.push_back({placed.cast<S>(), S(0), {}});
  }
  return points;
}

template <class S> class AreaOfEight : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(AreaOfEight, Scalars);

TYPED_TEST(AreaOfEight, KeepsWhatIsKeptPointByPoint) {
  using S = TypeParam;
  constexpr int kSets = 20000;
  const ReducerInfo* const area = find_reducer("area");
  Random random(31);
  int chosen = 0, four = 0;
  for (int i = 0; i < kSets; ++i) {
    const int kind = i % 6;
    SCOPED_TRACE("set " + std::to_string(i) + " of kind " + std::to_string(kind));
    Vec3<S> normal;
    const std::vector<ContactPoint<S>> points = draw<S>(random, kind, normal);
    KeptIndices kept;
    if (!area_of_eight(Candidates<S>{points, normal}, kept)) continue;
    ++chosen;
    std::vector<ContactPoint<double>> exact;
    for (const ContactPoint<S>& point : points)
      exact.push_back({point.position.template cast<double>(), 0, {}});
    const Vec3d direction = normal.template cast<double>();
    Choices watched{{exact, direction}};
    ReduceOptions options;
    options.choices = &watched;
    const KeptIndices expected = reduce(area, ContactPoints<S>(points), normal, options);
    ASSERT_EQ(std::vector<int>(kept.begin(), kept.end()),
              std::vector<int>(expected.begin(), expected.end()));
    four += kept.size() == 4 ? 1 : 0;
  }
  EXPECT_GT(chosen, kSets / 2);
  EXPECT_GT(four, kSets / 3);
}

TYPED_TEST(AreaOfEight, LeavesLinesAndLengthsWithoutSquaresAlone) {
  using S = TypeParam;
  std::vector<ContactPoint<S>> points(6);
  for (int i = 0; i < 6; ++i) points[i].position = {S(i), S(2 * i), S(0)};
  const Vec3<S> normal = Vec3<S>::UnitZ();
  KeptIndices kept;
  EXPECT_FALSE(area_of_eight(Candidates<S>{points, normal}, kept));
  for (int i = 0; i < 6; ++i) points[i].position = {S(i % 3), S(i % 2), S(0)};
  EXPECT_TRUE(area_of_eight(Candidates<S>{points, normal}, kept));
  for (int i = 0; i < 6; ++i) points[i].position *= sizeof(S) == 4 ? S(1e10) : S(1e80);
  EXPECT_FALSE(area_of_eight(Candidates<S>{points, normal}, kept));
}

}  // namespace
}  // namespace contactscope
