#include <gtest/gtest.h>

#include "geometry/hull_builder.h"
#include "geometry/shape.h"
#include "manifold/placed_shapes.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"

/// Hulls whose vertices are thousands of radii from the origin of their own frame, in float,
/// compared with brute force in double.
namespace contactscope {
namespace {

using test::PairCase;
using test::PlacedShapes;
using test::Random;

/// The same hull relative to another origin.
Hull<double> given_from(const Hull<double>& hull, const Vec3d& origin) {
  std::vector<Vec3d> points;
  for (const Vec3d& vertex : hull.vertices) points.push_back(vertex - origin);
  return build_hull(points);
}

/// Recentres a far shape as a scenario does: about its middle, with a pose that compensates.
void centre(Shape<double>& shape, Pose<double>& pose) {
  const Vec3d origin = moved_origin(shape);
  shape = seen_from(shape, origin);
  pose = compose(pose, {Quatd::Identity(), origin});
}

struct Seen {
  double depth = 0;  // metres, of the deepest point; 0 if the overlap was lost
  bool lost = true;
};

Seen seen_in_float(const PlacedShapes& pair) {
  CollideOptions options;
  options.preference = Preference::None;
  const Manifold<float> manifold = test::manifold_of<float>(pair, options);
  if (manifold.points.empty()) return {};
  return {-test::deepest(manifold), false};
}

/// Two hulls of about a metre that overlap by at least a hundredth of the smaller radius.
PairCase<double> overlapping_pair(Random& random, double& truth) {
  for (;;) {
    const PairCase<double> pair = test::everyday_pair(random);
    truth = test::brute_force_sat(pair.a, pair.pose_a, pair.b, pair.pose_b).separation;
    if (truth < -0.01 * std::min(pair.a.radius, pair.b.radius)) return pair;
  }
}

/// Error bound of a depth in float over the radii: clipping, and poses a metre from the origin.
constexpr double kDepthRounding = 2e-6;

class FarHulls : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Radii, FarHulls, testing::Values(1e3, 1e4, 1e5),
                         [](const auto& test) { return std::to_string(int(test.param)); });

TEST_P(FarHulls, GivenFarFromTheirOriginWithTheOppositePoseAreAsDeep) {
  Random random(21);
  int lost_unmoved = 0, wrong_unmoved = 0;
  for (int i = 0; i < 300; ++i) {
    double truth = 0;
    const PairCase<double> near = overlapping_pair(random, truth);
    const double radius = near.a.radius + near.b.radius;
    PlacedShapes far{near.a, near.pose_a, near.b, near.pose_b};
    const auto give_from_afar = [&](const Hull<double>& hull, Shape<double>& shape,
                                    Pose<double>& pose) {
      const Vec3d origin = GetParam() * hull.radius * random.unit_vector();
      shape = given_from(hull, origin);
      pose = compose(pose, {Quatd::Identity(), origin});
    };
    give_from_afar(near.a, far.a, far.pose_a);
    if (i % 2 == 0) give_from_afar(near.b, far.b, far.pose_b);

    const Seen unmoved = seen_in_float(far);
    lost_unmoved += unmoved.lost ? 1 : 0;
    wrong_unmoved += std::abs(unmoved.depth + truth) > kDepthRounding * radius ? 1 : 0;
    centre(far.a, far.pose_a);
    centre(far.b, far.pose_b);
    const Seen seen = seen_in_float(far);
    ASSERT_FALSE(seen.lost) << i;
    EXPECT_NEAR(seen.depth, -truth, kDepthRounding * radius + 4e-7) << i;
    const Seen as_near = seen_in_float({near.a, near.pose_a, near.b, near.pose_b});
    EXPECT_NEAR(seen.depth, as_near.depth, kDepthRounding * radius + 4e-7) << i;
  }
  // Without recentring, the same pairs must fail, or the test would prove nothing.
  EXPECT_GT(wrong_unmoved, 100);
  RecordProperty("lost_unmoved", lost_unmoved);
}

/// Level geometry: every hull is in the level's own coordinates, and all have the same pose.
TEST_P(FarHulls, InLevelCoordinatesLoseNoOverlap) {
  Random random(22);
  int wrong_unmoved = 0;
  for (int i = 0; i < 300; ++i) {
    double truth = 0;
    const PairCase<double> near = overlapping_pair(random, truth);
    const double radius = near.a.radius + near.b.radius;
    const Vec3d place = GetParam() * radius * random.unit_vector();
    const auto in_level = [&](const Hull<double>& hull, const Pose<double>& pose) {
      std::vector<Vec3d> points;
      for (const Vec3d& vertex : hull.vertices)
        points.push_back(pose.transform(vertex) - near.pose_a.position + place);
      return build_hull(points);
    };
    PlacedShapes level{in_level(near.a, near.pose_a), {}, in_level(near.b, near.pose_b), {}};
    const Seen unmoved = seen_in_float(level);
    wrong_unmoved += std::abs(unmoved.depth + truth) > kDepthRounding * radius ? 1 : 0;
    centre(level.a, level.pose_a);
    centre(level.b, level.pose_b);
    // The poses are floats, so the level's size does not affect the depth. The points are in level
    // coordinates, where a float has fewer digits.
    const Seen seen = seen_in_float(level);
    ASSERT_FALSE(seen.lost) << i;
    EXPECT_NEAR(seen.depth, -truth, kDepthRounding * radius) << i;
  }
  EXPECT_GT(wrong_unmoved, 100);
}

}  // namespace
}  // namespace contactscope
