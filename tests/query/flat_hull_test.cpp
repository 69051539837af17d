#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "geometry/hull_builder.h"
#include "query/gjk.h"
#include "query/penetration.h"
#include "query/sat.h"
#include "query/tolerance.h"
#include "support/brute_force_distance.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"
#include "support/cases.h"

/// Flat hulls against solid ones and against each other in every query, compared with exhaustion.
namespace contactscope {
namespace {

using test::PairCase;
using test::Random;

/// A polygon of up to `corners` corners, turned at random.
Hull<double> random_polygon(Random& random, int corners, double size) {
  const Quatd turn = random.rotation();
  const double width = random.uniform(0.4, 1);
  std::vector<Vec3d> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = (i + random.uniform(0, 0.4)) * 2 * std::numbers::pi / corners;
    points.push_back(turn * Vec3d(size * std::cos(angle), 0, width * size * std::sin(angle)));
  }
  return build_hull(points, {.allow_flat = true});
}

/// Turns B's normal onto A's and moves B into A's plane; at best as parallel as rotations can be.
void make_parallel(Random& random, PairCase<double>& pair) {
  const Vec3d normal_a = pair.pose_a.rotate(pair.a.planes[0].normal);
  const Vec3d normal_b = pair.pose_b.rotate(pair.b.planes[0].normal);
  const Quatd tilt = random.chance(0.5) ? Quatd(Quatd::Identity()) : random.rotation_by(1e-3);
  pair.pose_b.rotation = tilt * Quatd::FromTwoVectors(normal_b, normal_a) * pair.pose_b.rotation;
  pair.pose_b.rotation.normalize();
  const Vec3d between =
      pair.pose_b.transform(pair.b.centroid) - pair.pose_a.transform(pair.a.centroid);
  pair.pose_b.position -= normal_a.dot(between) * normal_a;
}

/// At least one hull is flat, A or B; many pairs overlap.
PairCase<double> random_flat_pair(Random& random, int index) {
  const Hull<double> flat = random_polygon(random, 3 + random.index(6), 1);
  const bool both = index % 3 == 2;
  const Hull<double> other = both             ? random_polygon(random, 3 + random.index(6), 0.8)
                             : index % 2 == 0 ? test::random_box(random, 0.6, 3)
                                              : test::random_hull(random, 12, 0.6, 3);
  PairCase<double> pair{flat, random.pose(1), other, random.pose(1)};
  const Vec3d separated = random.uniform(0, 1.4) * random.unit_vector();
  pair.pose_b.position =
      pair.pose_a.transform(pair.a.centroid) + separated - pair.pose_b.rotate(pair.b.centroid);
  if (both && index % 2 == 0) make_parallel(random, pair);
  return index % 4 < 2 ? pair : test::swapped(pair);
}

/// The largest separation along outward directions of edges in a flat hull's plane; of B if `of_b`.
double separation_by_sides(const PairCase<double>& pair, bool of_b) {
  const Hull<double>& hull = of_b ? pair.b : pair.a;
  const Pose<double>& pose = of_b ? pair.pose_b : pair.pose_a;
  double best = -std::numeric_limits<double>::infinity();
  if (hull.face_count() != 2) return best;
  for (int edge = 0; edge < 2 * hull.edge_count(); ++edge) {
    const Vec3d along = (hull.target(edge) - hull.origin(edge)).normalized();
    const Vec3d side = pose.rotate(Vec3d(along.cross(hull.planes[0].normal)));
    for (const Vec3d& direction : {side, Vec3d(-side)})
      best = std::max(best,
                      test::separation_along(direction, pair.a, pair.pose_a, pair.b, pair.pose_b));
  }
  return best;
}

double largest_separation(const PairCase<double>& pair) {
  const double axes = test::brute_force_sat(pair.a, pair.pose_a, pair.b, pair.pose_b).separation;
  return std::max({axes, separation_by_sides(pair, false), separation_by_sides(pair, true)});
}

template <class S> class FlatHulls : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(FlatHulls, Scalars);

TYPED_TEST(FlatHulls, HaveTheAxisThatExhaustionFinds) {
  using S = TypeParam;
  Random random(5);
  int overlaps = 0, separated = 0, edges = 0;
  for (int i = 0; i < test::cases(6000); ++i) {
    const PairCase<S> pair = random_flat_pair(random, i).template cast<S>();
    const PairCase<double> exact = pair.template cast<double>();
    const double truth = largest_separation(exact);
    const double rounding = 32 * std::numeric_limits<S>::epsilon() * test::length_scale(exact);
    const HullPair<S> placed(pair.a, pair.b, relative_pose(pair.pose_a, pair.pose_b));
    const SatResult<S> axes = sat(placed, S(0), Preference::None);
    if (truth > rounding) {
      ++separated;
      ASSERT_EQ(axes.status, SatStatus::Separated) << i << ": " << truth;
    } else if (truth < -rounding) {
      ++overlaps;
      ASSERT_EQ(axes.status, SatStatus::Touching) << i << ": " << truth;
    }
    if (axes.status == SatStatus::Touching) {
      ASSERT_NEAR(axes.separation(axes.chosen), truth, rounding) << i;
      edges += axes.chosen == AxisKind::EdgeEdge ? 1 : 0;
    }
  }
  EXPECT_GT(overlaps, 1000 / test::kOneIn);
  EXPECT_GT(separated, 1000 / test::kOneIn);
  EXPECT_GT(edges, 500 / test::kOneIn);
}

TYPED_TEST(FlatHulls, HaveTheDistanceThatExhaustionFinds) {
  using S = TypeParam;
  Random random(6);
  int separated = 0;
  for (int i = 0; i < test::cases(1500); ++i) {
    const PairCase<S> pair = random_flat_pair(random, i).template cast<S>();
    const PairCase<double> exact = pair.template cast<double>();
    const double scale = test::length_scale(exact);
    const GjkResult<S> found =
        gjk(support_set(pair.a), support_set(pair.b), relative_pose(pair.pose_a, pair.pose_b));
    if (largest_separation(exact) < 1e-4 * scale) continue;
    ++separated;
    const auto truth =
        static_cast<double>(test::brute_force_distance(test::features_of(exact.a, exact.pose_a),
                                                       test::features_of(exact.b, exact.pose_b))
                                .distance);
    ASSERT_EQ(found.status, GjkStatus::Separated) << i;
    ASSERT_NEAR(found.distance, truth, 64 * std::numeric_limits<S>::epsilon() * scale) << i;
  }
  EXPECT_GT(separated, 300 / test::kOneIn);
}

TYPED_TEST(FlatHulls, AreAsDeepByEveryMethodAsExhaustionFinds) {
  using S = TypeParam;
  Random random(7);
  int deep = 0, converged = 0;
  for (int i = 0; i < test::cases(3000); ++i) {
    const PairCase<S> pair = random_flat_pair(random, i).template cast<S>();
    const PairCase<double> exact = pair.template cast<double>();
    const double truth = largest_separation(exact);
    const double rounding = 64 * std::numeric_limits<S>::epsilon() * test::length_scale(exact);
    if (truth > -rounding) continue;
    ++deep;
    for (const PenetrationMethod method :
         {PenetrationMethod::Sat, PenetrationMethod::Epa, PenetrationMethod::Mpr}) {
      SCOPED_TRACE(std::string(to_string(method)) + " of pair " + std::to_string(i));
      const PenetrationResult<S> found =
          penetration(method, support_set(pair.a), support_set(pair.b),
                      relative_pose(pair.pose_a, pair.pose_b));
      ASSERT_TRUE(has_depth(found.status)) << truth;
      ASSERT_GE(found.depth, -truth - rounding);
      const bool is_exact =
          method == PenetrationMethod::Sat ||
          (method == PenetrationMethod::Epa && found.status == PenetrationStatus::Converged);
      if (!is_exact) continue;  // separates them, but not by the shortest translation
      converged += method == PenetrationMethod::Epa ? 1 : 0;
      ASSERT_LE(found.depth, -truth + rounding);
    }
  }
  EXPECT_GT(deep, 500 / test::kOneIn);
  EXPECT_GT(converged, deep * 99 / 100);
}

TYPED_TEST(FlatHulls, CoplanarSideBySideAreSeparated) {
  using S = TypeParam;
  const Hull<double> plate = build_hull(
      std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {.allow_flat = true});
  for (const double yaw : {0.0, 0.3, std::numbers::pi}) {
    const PairCase<double> pair{
        plate, Pose<double>(), plate, {test::about(Vec3d::UnitY(), yaw), {2.5, 0, 0.2}}};
    const PairCase<S> rounded = pair.template cast<S>();
    const HullPair<S> placed(rounded.a, rounded.b, relative_pose(rounded.pose_a, rounded.pose_b));
    const SatResult<S> axes = sat(placed, S(0), Preference::Relative);
    EXPECT_EQ(axes.status, SatStatus::Separated);
    EXPECT_EQ(axes.chosen, AxisKind::EdgeEdge);
    const double separated =
        std::max(separation_by_sides(pair, false), separation_by_sides(pair, true));
    EXPECT_NEAR(axes.edge.separation, separated, 1e-5) << yaw;
    EXPECT_GE(axes.edge.edge_b, 0);
  }
}

// Each separates along a side of either hull in the direction of the other: the normal points from
// A to B, and the hulls lie on different sides.
TYPED_TEST(FlatHulls, CoplanarSideBySideHaveASeparatingNormal) {
  using S = TypeParam;
  const auto flat = [](const std::vector<Vec3d>& corners) {
    return build_hull(corners, {.allow_flat = true});
  };
  const Hull<double> plate = flat({{-0.5, 0, -0.3}, {0.5, 0, -0.3}, {0.5, 0, 0.3}, {-0.5, 0, 0.3}});
  const Hull<double> triangle = flat({{-0.4, 0, -0.3}, {0.5, 0, -0.2}, {0, 0, 0.4}});
  int of_first = 0, of_second = 0;
  for (int turn = 0; turn < 32; ++turn) {
    const double angle = turn * std::numbers::pi / 16;
    const Vec3d place = 1.3 * Vec3d(std::cos(angle), 0, std::sin(angle));
    const PairCase<double> exact{
        plate, Pose<double>(), triangle, {test::about(Vec3d::UnitY(), 0.7 * turn), place}};
    const PairCase<S> pair = exact.template cast<S>();
    const HullPair<S> placed(pair.a, pair.b, relative_pose(pair.pose_a, pair.pose_b));
    const auto gap_along = [&](const Vec3d& normal) {
      return test::separation_along(normal, exact.a, exact.pose_a, exact.b, exact.pose_b);
    };
    const auto gap = [&](const EdgeQuery<S>& found) {
      return gap_along(found.normal.template cast<double>());
    };
    // The largest separation along the directions away from the edges of one hull.
    const auto gap_next_to = [&](const Hull<double>& hull, const Pose<double>& pose, double to_b) {
      double most = -std::numeric_limits<double>::infinity();
      for (int edge = 0; edge < 2 * hull.edge_count(); ++edge) {
        const Vec3d along = (hull.target(edge) - hull.origin(edge)).normalized();
        const Vec3d normal = hull.planes[static_cast<std::size_t>(
                                             hull.half_edges[static_cast<std::size_t>(edge)].face)]
                                 .normal;
        most = std::max(most, gap_along(Vec3d(to_b * pose.rotate(Vec3d(along.cross(normal))))));
      }
      return most;
    };
    const EdgeQuery<S> sides = query_sides(placed);
    const double of_a = gap_next_to(exact.a, exact.pose_a, 1);
    const double of_b = gap_next_to(exact.b, exact.pose_b, -1);
    EXPECT_NEAR(sides.separation, std::max(of_a, of_b), 1e-5) << turn;
    EXPECT_NEAR(gap(sides), sides.separation, 1e-5) << turn;
    ++(of_a > of_b ? of_first : of_second);
    const SatResult<S> axes = sat(placed, S(0), Preference::Relative);
    ASSERT_EQ(axes.status, SatStatus::Separated) << turn;
    EXPECT_GT(axes.edge.separation, 0.1) << turn;
    EXPECT_NEAR(gap(axes.edge), axes.edge.separation, 1e-5) << turn;
  }
  EXPECT_GT(of_first, 5);
  EXPECT_GT(of_second, 5);
}

TYPED_TEST(FlatHulls, OnOnePlaneTouchWithDepthZero) {
  using S = TypeParam;
  const Hull<double> plate = build_hull(
      std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {.allow_flat = true});
  const PairCase<double> pair{plate, Pose<double>(), plate, test::at(0.5, 0, 0.25)};
  CollideOptions options;
  const Manifold<S> manifold = test::collide(pair.template cast<S>(), options);
  ASSERT_EQ(manifold.points.size(), 4u);
  for (const ContactPoint<S>& point : manifold.points) EXPECT_EQ(point.separation, S(0));
  EXPECT_EQ(std::abs(manifold.normal.y()), S(1));
}

TYPED_TEST(FlatHulls, LieOnABoxWithAllCorners) {
  using S = TypeParam;
  const Hull<double> plate =
      build_hull(std::vector<Vec3d>{{-0.3, 0, -0.2}, {0.3, 0, -0.2}, {0.3, 0, 0.2}, {-0.3, 0, 0.2}},
                 {.allow_flat = true});
  // Below the middle of the plate is the box's inside, above it is air. The plate is pushed out
  // through the top, whichever of its sides is nearer.
  const PairCase<double> on_top{plate, test::at(0, 0.49, 0), test::cube(0.5), test::at(0, 0, 0)};
  for (const PairCase<double>& pair : {on_top, test::swapped(on_top)}) {
    const Manifold<S> manifold = test::collide(pair.template cast<S>());
    ASSERT_EQ(manifold.points.size(), 4u);
    EXPECT_NEAR(test::deepest(manifold), -0.01, 1e-6);
    EXPECT_NEAR(std::abs(manifold.normal.y()), 1, 1e-6);
  }
}

TYPED_TEST(FlatHulls, MakeTheSameContactsWithAndWithoutACache) {
  using S = TypeParam;
  Random random(8);
  int touching = 0;
  for (int i = 0; i < 300; ++i) {
    PairCase<double> pair = random_flat_pair(random, i);
    PairCache<S> cache;
    for (int frame = 0; frame < 6; ++frame) {
      pair.pose_b.position += 0.002 * random.unit_vector();
      const PairCase<S> rounded = pair.template cast<S>();
      const Manifold<S> cached = collide_hull_hull(rounded.a, rounded.pose_a, rounded.b,
                                                   rounded.pose_b, CollideOptions(), &cache);
      const Manifold<S> whole = test::collide(rounded);
      ASSERT_EQ(cached.points.empty(), whole.points.empty()) << i << ' ' << frame;
      if (whole.points.empty()) continue;
      ++touching;
      const double best = test::deepest(whole);
      const double allowed =
          preference_tolerance(static_cast<S>(best), std::min(rounded.a.radius, rounded.b.radius));
      ASSERT_NEAR(test::deepest(cached), best, allowed + 1e-6) << i << ' ' << frame;
    }
  }
  EXPECT_GT(touching, 300);
}

}  // namespace
}  // namespace contactscope
