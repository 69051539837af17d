#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/convex_polygon.h"
#include "geometry/hull_builder.h"
#include "geometry/primitives.h"
#include "query/gjk.h"
#include "support/brute_force_distance.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"
#include "support/cases.h"
#include "support/random_geometry.h"

/// Final status of GJK: separated, overlapping, or on the border between the two, and then by no
/// more than rounding. Compared with the separating axis test by exhaustion, in double.
namespace contactscope {
namespace {

using test::Random;

/// A prism of a polygon along z.
Hull<double> prism(const std::vector<Vec2d>& corners, double half_height) {
  std::vector<Vec3d> points;
  for (const double z : {-half_height, half_height})
    for (const Vec2d& corner : corners) points.emplace_back(corner.x(), corner.y(), z);
  return build_hull(points);
}

Hull<double> random_prism(Random& random, double size, double half_height) {
  const int count = 3 + random.index(4);
  const double from = random.uniform(0, 6);
  std::vector<Vec2d> corners;
  for (int i = 0; i < count; ++i) {
    const double angle = from + 6.283185307179586 * i / count;
    corners.emplace_back(size * std::cos(angle), size * std::sin(angle));
  }
  return prism(corners, half_height);
}

struct HullPairInA {
  Hull<double> a, b;
  Pose<double> b_in_a;
};

/// Planes of symmetry in GJK: prisms seen along their edges and boxes side by side, whose simplex
/// lies in a plane through the origin or on a line. Other hulls serve as a control.
HullPairInA symmetric_pair(Random& random) {
  const double size = random.decade(-4, 4), other = size * random.decade(-1, 1);
  const int kind = random.index(4);
  const auto shape = [&](double reach) {
    if (kind == 0) return random_prism(random, reach, 0.5 * size);  // as high as the other
    if (kind == 1) return test::random_box(random, reach, 5);
    return test::random_hull(random, 4 + random.index(5), reach, 4);
  };
  HullPairInA pair{shape(size), shape(other), {}};
  Vec3d direction = random.unit_vector();
  if (kind == 0) {
    pair.b_in_a.rotation = test::about(Vec3d::UnitZ(), random.uniform(-3, 3));
    direction = Vec3d(direction.x(), direction.y(), 0).normalized();
  } else if (kind == 1) {
    direction = Vec3d::Unit(random.index(3));
  } else {
    pair.b_in_a.rotation = random.rotation();
  }
  // Deep, barely overlapping, barely separated and far.
  const double depths[] = {0.2, 0.9, 0.999, 0.99999, 1, 1.00001, 1.001, 1.3};
  const double separation = test::separation_along(direction, pair.a, {}, pair.b,
                                                   pair.b_in_a);  // with coincident origins
  pair.b_in_a.position = -separation * depths[random.index(8)] * direction;
  return pair;
}

template <class S> HullPairInA rounded(const HullPairInA& pair) {
  const auto same = [](const Hull<double>& hull) { return hull_cast<double>(hull_cast<S>(hull)); };
  Pose<double> b_in_a = pair.b_in_a.cast<S>().template cast<double>();
  b_in_a.rotation.normalize();
  return {same(pair.a), same(pair.b), b_in_a};
}

template <class S> GjkResult<S> gjk_of(const HullPairInA& pair) {
  const Hull<S> a = hull_cast<S>(pair.a), b = hull_cast<S>(pair.b);
  return gjk(support_set(a), support_set(b), pair.b_in_a.cast<S>());
}

template <class S> void judge_endings(int count, std::uint64_t seed) {
  Random random(seed);
  int separated = 0, together = 0, planar = 0;
  for (int i = 0; i < count; ++i) {
    const HullPairInA pair = rounded<S>(symmetric_pair(random));
    const double separation = test::brute_force_sat(pair.a, {}, pair.b, pair.b_in_a).separation;
    const double lengths = pair.a.radius + pair.b.radius + pair.a.centroid.norm() +
                           pair.b.centroid.norm() + pair.b_in_a.position.norm();
    const double rounding = 16 * static_cast<double>(std::numeric_limits<S>::epsilon()) * lengths;
    const GjkResult<S> result = gjk_of<S>(pair);
    if (separation > rounding) {
      ++separated;
      ASSERT_EQ(result.status, GjkStatus::Separated)
          << "pair " << i << ", " << separation / lengths;
    } else if (separation < -rounding) {
      ++together;
      planar += result.simplex.vertices.size() < 4 ? 1 : 0;
      ASSERT_EQ(result.status, GjkStatus::Overlap) << "pair " << i << ", " << separation / lengths;
      ASSERT_EQ(result.distance, S(0));
    }
  }
  EXPECT_GT(separated, count / 5);
  EXPECT_GT(together, count / 5);
  EXPECT_GT(planar, count / 200);
}

TEST(GjkStatus, PrismsSeenAlongTheirEdgesOverlap) {
  const Hull<double> block =
      prism({{-0.6, -0.4}, {0.5, -0.4}, {0.7, 0}, {0.2, 0.45}, {-0.6, 0.3}}, 0.2);
  const Hull<double> wedge = prism({{0, -0.5}, {-0.55, 0.3}, {0.5, 0.35}}, 0.2);
  const HullPairInA pair{
      block, wedge, {test::about(Vec3d::UnitZ(), -15 * test::kDegree), Vec3d(0.45, 0.35, 0)}};
  EXPECT_NEAR(test::brute_force_sat(block, {}, wedge, pair.b_in_a).separation, -0.353, 0.001);
  EXPECT_EQ(gjk_of<double>(pair).status, GjkStatus::Overlap);
  EXPECT_EQ(gjk_of<float>(pair).status, GjkStatus::Overlap);
}

TEST(GjkStatus, TheSameBoxTwiceOverlaps) {
  const Hull<double> box = make_box(Vec3d(1, 2, 3));
  EXPECT_EQ(gjk_of<double>({box, box, {}}).status, GjkStatus::Overlap);
  EXPECT_EQ(gjk_of<float>({box, box, {}}).status, GjkStatus::Overlap);
}

TEST(GjkStatus, RandomPairsEndAsTheyStand) {
  judge_endings<double>(2000, 341);
  judge_endings<float>(2000, 342);
}

TEST(GjkStatus, SlowRandomPairs) {
  judge_endings<double>(test::cases(10'000), 343);
  judge_endings<float>(test::cases(10'000), 344);
}

}  // namespace
}  // namespace contactscope
