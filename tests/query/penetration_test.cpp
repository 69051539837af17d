#include "query/penetration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "geometry/hull_builder.h"
#include "query/penetration_bounds.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"

namespace contactscope {
namespace {

using test::about;
using test::at;
using test::PairCase;
using test::Random;

constexpr PenetrationMethod kEveryMethod[] = {PenetrationMethod::Sat, PenetrationMethod::Epa,
                                              PenetrationMethod::Mpr, PenetrationMethod::Sampling};

template <class S>
PenetrationResult<S> penetration_of(PenetrationMethod method, const PairCase<S>& pair,
                                    const PenetrationOptions<S>& options = {}) {
  return penetration(method, support_set(pair.a), support_set(pair.b),
                     relative_pose(pair.pose_a, pair.pose_b), options);
}

template <class S> class Penetration : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Penetration, Scalars);

TYPED_TEST(Penetration, StackedCubesHaveTheOverlapUpwardFromATenthOfAMillimetreTo10Km) {
  using S = TypeParam;
  for (double size = 1e-4; size < 2e4; size *= 10) {
    PairCase<double> pair{test::cube(0.5 * size),
                          at(0, 0, 0),
                          test::cube(0.5 * size),
                          {about(Vec3d::UnitY(), 0.3), {0.1 * size, 0.95 * size, 0}}};
    for (const PenetrationMethod method : kEveryMethod) {
      SCOPED_TRACE(std::string(to_string(method)) + " at " + std::to_string(size));
      const PenetrationResult<S> found = penetration_of(method, pair.cast<S>());
      ASSERT_EQ(found.status, PenetrationStatus::Converged);
      // Sampling approaches the result by halving angles; its depth is first order in the angle.
      const bool exact = method != PenetrationMethod::Sampling;
      const double tolerance = exact ? 32 * std::numeric_limits<S>::epsilon() : 2e-3;
      EXPECT_NEAR(static_cast<double>(found.depth) / size, 0.05, tolerance);
      EXPECT_NEAR(static_cast<double>(found.normal.y()), 1, tolerance);
      EXPECT_NEAR(static_cast<double>(found.on_a.y()) / size, 0.5, 10 * tolerance);
      EXPECT_NEAR(static_cast<double>(found.on_b.y()) / size, 0.45, 10 * tolerance);
    }
  }
}

TYPED_TEST(Penetration, CrossedEdgesHaveTheirCrossProduct) {
  using S = TypeParam;
  const PairCase<S> pair = test::crossed_edges(1, 0.03).cast<S>();
  for (const PenetrationMethod method : {PenetrationMethod::Epa, PenetrationMethod::Mpr}) {
    const PenetrationResult<S> found = penetration_of(method, pair);
    EXPECT_EQ(found.status, PenetrationStatus::Converged);
    EXPECT_NEAR(found.depth, 0.03, 32 * std::numeric_limits<S>::epsilon());
    const Vec3<S> world = pair.pose_a.rotate(found.normal);
    EXPECT_NEAR(world.y(), 1, 32 * std::numeric_limits<S>::epsilon());
  }
}

TYPED_TEST(Penetration, SeparatedCoresAreReported) {
  using S = TypeParam;
  for (const double gap : {1e-3, 0.1, 10.0}) {
    const PairCase<S> pair = test::stacked_cubes(0.3, -gap).cast<S>();
    for (const PenetrationMethod method : kEveryMethod) {
      // 256 directions are 0.17 rad from each other; a narrower cone of separating axes is missed.
      if (method == PenetrationMethod::Sampling && gap < 0.5) continue;
      EXPECT_EQ(penetration_of(method, pair).status, PenetrationStatus::Separated)
          << to_string(method) << " " << gap;
    }
  }
}

TYPED_TEST(Penetration, NonFiniteNumbersAreReported) {
  using S = TypeParam;
  const PairCase<S> good = test::stacked_cubes(0.3, 0.01).cast<S>();
  for (const S bad : {std::numeric_limits<S>::quiet_NaN(), std::numeric_limits<S>::infinity()}) {
    PairCase<S> position = good, rotation = good, vertices = good;
    position.pose_b.position.y() = bad;
    rotation.pose_b.rotation.z() = bad;
    for (Vec3<S>& vertex : vertices.b.vertices) vertex.x() = bad;
    vertices.b.centroid.x() = bad;
    lay_out(vertices.b);
    for (const PenetrationMethod method : kEveryMethod) {
      for (const PairCase<S>& pair : {position, rotation, vertices}) {
        EXPECT_EQ(penetration_of(method, pair).status, PenetrationStatus::NotFinite)
            << to_string(method);
      }
    }
  }
}

TYPED_TEST(Penetration, CrossingSegmentsAreFlatAndAcrossBoth) {
  using S = TypeParam;
  const Vec3<S> along_x[2] = {{-1, 0, 0}, {1, 0, 0}}, along_z[2] = {{0, 0, -1}, {0, 0, 2}};
  for (const PenetrationMethod method : {PenetrationMethod::Sat, PenetrationMethod::Epa}) {
    const PenetrationResult<S> found =
        penetration<S>(method, support_set(along_x), support_set(along_z), Pose<S>());
    EXPECT_EQ(found.status, PenetrationStatus::Flat) << to_string(method);
    EXPECT_EQ(found.depth, 0);
    EXPECT_NEAR(std::abs(found.normal.y()), 1, 1e-6);
    EXPECT_NEAR(found.on_a.norm(), 0, 1e-6);
    EXPECT_NEAR(found.on_b.norm(), 0, 1e-6);
  }
}

TYPED_TEST(Penetration, CollinearSegmentsAndEqualPointsAreFlat) {
  using S = TypeParam;
  const Vec3<S> one[2] = {{-1, 0, 0}, {1, 0, 0}}, other[2] = {{0, 0, 0}, {2, 0, 0}};
  const Vec3<S> point(S(0.5), 0, 0);
  const auto flat = [](const SupportSet<S>& a, const SupportSet<S>& b) {
    const PenetrationResult<S> found = penetration<S>(PenetrationMethod::Epa, a, b, Pose<S>());
    EXPECT_EQ(found.status, PenetrationStatus::Flat);
    EXPECT_EQ(found.depth, 0);
    EXPECT_NEAR(found.normal.norm(), 1, 1e-6);
    return found.normal;
  };
  EXPECT_NEAR(flat(support_set(one), support_set(other)).x(), 0, 1e-6);
  EXPECT_NEAR(flat(support_set(one), support_set(point)).x(), 0, 1e-6);
  flat(support_set(point), support_set(point));
}

TYPED_TEST(Penetration, PointsAndSegmentsInABoxLeaveByTheNearestFace) {
  using S = TypeParam;
  const Hull<S> box = hull_cast<S>(make_box(Vec3d(1, 2, 3)));
  const S tolerance = 32 * std::numeric_limits<S>::epsilon();
  const Vec3<S> point(S(0.75), S(0.5), 1), ends[2] = {{S(0.5), 0, -1}, {S(0.75), 1, 1}};
  Random random(7);
  for (const PenetrationMethod method : {PenetrationMethod::Sat, PenetrationMethod::Epa}) {
    for (int i = 0; i < 50; ++i) {
      const Pose<S> pose = random.pose(2).cast<S>();
      const PenetrationResult<S> of_point =
          penetration<S>(method, support_set(box), support_set(point), Pose<S>());
      EXPECT_NEAR(of_point.depth, 0.25, tolerance);
      EXPECT_NEAR(of_point.normal.x(), 1, tolerance);
      // Swapped, and from a frame somewhere else: B's values become A's.
      Vec3<S> moved[2];
      for (int k = 0; k < 2; ++k) moved[k] = pose.transform(ends[k]);
      const PenetrationResult<S> of_segment =
          penetration<S>(method, support_set(moved), support_set(box), pose);
      EXPECT_NEAR(of_segment.depth, 0.5, 8 * tolerance);
      EXPECT_NEAR(pose.inverse_rotate(of_segment.normal).x(), -1, 8 * tolerance);
      EXPECT_NEAR((of_segment.on_a - moved[0]).norm(), 0, 32 * tolerance);
    }
  }
}

TYPED_TEST(Penetration, SwappedShapesAreOppositeAndAsDeep) {
  using S = TypeParam;
  Random random(11);
  for (int i = 0; i < 300; ++i) {
    PairCase<double> drawn = test::everyday_pair(random);
    const PairCase<S> pair = drawn.cast<S>();
    const PenetrationResult<S> one = penetration_of(PenetrationMethod::Epa, pair);
    const PenetrationResult<S> other = penetration_of(PenetrationMethod::Epa, test::swapped(pair));
    const double tolerance = 256 * test::length_scale(pair) * std::numeric_limits<S>::epsilon();
    ASSERT_TRUE(!(one.depth > tolerance) || has_depth(other.status)) << i;
    ASSERT_NEAR(one.depth, other.depth, tolerance) << i;
  }
}

TYPED_TEST(Penetration, IsTheSameBitForBitWhenWatched) {
  using S = TypeParam;
  Random random(13);
  for (int i = 0; i < 200; ++i) {
    const PairCase<S> pair = test::everyday_pair(random).cast<S>();
    const Pose<S> b_in_a = relative_pose(pair.pose_a, pair.pose_b);
    for (const PenetrationMethod method : kEveryMethod) {
      PenetrationSteps<S> steps;
      const auto alone = penetration<S>(method, support_set(pair.a), support_set(pair.b), b_in_a);
      const auto watched = penetration<S>(method, support_set(pair.a), support_set(pair.b), b_in_a,
                                          {}, nullptr, &steps);
      ASSERT_EQ(alone.status, watched.status);
      ASSERT_EQ(alone.depth, watched.depth);
      ASSERT_EQ(alone.normal, watched.normal);
      ASSERT_EQ(alone.on_a, watched.on_a);
      ASSERT_EQ(alone.on_b, watched.on_b);
      if (!has_depth(watched.status)) continue;
      ASSERT_EQ(!steps.polytopes.empty(), method == PenetrationMethod::Epa);
      ASSERT_EQ(!steps.directions.empty(), method == PenetrationMethod::Sampling);
    }
  }
}

TEST(Epa, ItsPolytopesAreClosedConvexAroundTheOriginAndGrow) {
  Random random(17);
  int seen = 0;
  for (int i = 0; i < 300; ++i) {
    const PairCase<double> pair = test::everyday_pair(random);
    PenetrationSteps<double> steps;
    const auto found =
        penetration<double>(PenetrationMethod::Epa, support_set(pair.a), support_set(pair.b),
                            relative_pose(pair.pose_a, pair.pose_b), {}, nullptr, &steps);
    const double tolerance = 1e-12 * test::length_scale(pair);
    double before = -tolerance;
    for (const PolytopeStep<double>& step : steps.polytopes) {
      ASSERT_GE(step.distance, before - tolerance) << i;
      ASSERT_LE(step.distance, static_cast<double>(found.depth) + tolerance) << i;
      before = step.distance;
      std::set<std::pair<int, int>> edges;
      for (const auto& [u, v, w] : step.faces) {
        for (const auto& edge : {std::pair(u, v), std::pair(v, w), std::pair(w, u)}) {
          ASSERT_TRUE(edges.insert(edge).second) << i;
        }
        const auto point = [&](int k) {
          const auto& vertex = step.vertices[static_cast<std::size_t>(k)];
          return Vec3d(vertex.b - vertex.a);
        };
        const Vec3d side1 = point(v) - point(u), side2 = point(w) - point(u);
        const Vec3d cross = side1.cross(side2);
        // Thin faces are uncertain by rounding divided by their thickness.
        if (cross.norm() < 1e-3 * side1.norm() * side2.norm()) continue;
        ASSERT_GE(cross.normalized().dot(point(u)), -1e3 * tolerance) << i;
        for (std::size_t k = 0; k < step.vertices.size(); ++k) {
          const Vec3d to_vertex = point(static_cast<int>(k)) - point(u);
          ASSERT_LE(cross.normalized().dot(to_vertex), 1e3 * tolerance) << i;
        }
      }
      for (const auto& [u, v] : edges) ASSERT_EQ(edges.count({v, u}), 1u) << i;
      ASSERT_EQ(step.vertices.size() + step.faces.size(), edges.size() / 2 + 2) << i;
      ASSERT_GE(step.nearest, 0);
      ++seen;
    }
  }
  EXPECT_GT(seen, 500);
}

// The difference of two level boxes has rectangular sides with many corners. Triangles on a side
// are replaced together with it, or triangles as thin as rounding would remain.
TEST(Epa, FacesOnOnePlaneAreReplacedTogether) {
  Random random(23);
  int steps_seen = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3d half_a(random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1));
    const Vec3d half_b(random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1));
    const Vec3d place =
        0.9 * Vec3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))
                  .cwiseProduct(half_a + half_b);
    const PairCase<double> pair{
        make_box(half_a), at(0, 0, 0), make_box(half_b), {Quatd::Identity(), place}};
    PenetrationSteps<double> steps;
    const auto found =
        penetration<double>(PenetrationMethod::Epa, support_set(pair.a), support_set(pair.b),
                            relative_pose(pair.pose_a, pair.pose_b), {}, nullptr, &steps);
    ASSERT_EQ(found.status, PenetrationStatus::Converged) << i;
    ASSERT_NEAR(found.depth, (half_a + half_b - place.cwiseAbs()).minCoeff(), 1e-14) << i;
    for (const PolytopeStep<double>& step : steps.polytopes) {
      for (const std::array<int, 3>& face : step.faces) {
        const auto point = [&](int k) {
          const GjkVertex<double>& vertex =
              step.vertices[static_cast<std::size_t>(face[static_cast<std::size_t>(k)])];
          return Vec3d(vertex.b - vertex.a);
        };
        const Vec3d side1 = point(1) - point(0), side2 = point(2) - point(0);
        const double longest = std::max(side1.norm(), side2.norm());
        ASSERT_GT(side1.cross(side2).norm() / longest, 1e-6) << i;
      }
      ++steps_seen;
    }
  }
  EXPECT_GT(steps_seen, 200);
}

TEST(Epa, TakesTheSimplexOfAnotherPlaceForAHintOnly) {
  Random random(19);
  int stale = 0;
  for (int i = 0; i < 300; ++i) {
    PairCase<double> pair = test::everyday_pair(random);
    const SupportSet<double> a = support_set(pair.a), b = support_set(pair.b);
    const auto earlier = gjk(a, b, relative_pose(pair.pose_a, pair.pose_b));
    pair.pose_b.position += 0.3 * random.unit_vector();
    const Pose<double> b_in_a = relative_pose(pair.pose_a, pair.pose_b);
    const auto again = epa<double>(a, b, b_in_a, {}, nullptr, nullptr);
    const auto hinted = epa<double>(a, b, b_in_a, {}, &earlier.simplex, nullptr);
    ASSERT_EQ(has_depth(again.status), has_depth(hinted.status)) << i;
    ASSERT_NEAR(again.depth, hinted.depth, 1e-13) << i;
    stale += has_depth(again.status) ? 1 : 0;
  }
  EXPECT_GT(stale, 50);
}

/// Two balls of a thousand vertices, one in the middle of the other. Every direction is nearly as
/// good, so both bounds meet only after all relevant faces have been found.
PairCase<double> balls_in_each_other() {
  Random random(23);
  std::vector<Vec3d> points;
  for (int i = 0; i < 1000; ++i) points.push_back(random.unit_vector());
  const Hull<double> ball = build_hull(points);
  return {ball, Pose<double>(), ball, {random.rotation(), Vec3d(1e-3, 2e-3, -1e-3)}};
}

TEST(Epa, StillSeparatesAtTheIterationLimit) {
  const PairCase<double> pair = balls_in_each_other();
  double last = std::numeric_limits<double>::infinity();
  for (const int allowed : {1, 4, 16, 64, 0}) {
    PenetrationOptions<double> options;
    options.max_iterations = allowed;
    const auto found = penetration_of(PenetrationMethod::Epa, pair, options);
    EXPECT_EQ(found.status, PenetrationStatus::OutOfIterations) << allowed;
    EXPECT_EQ(found.iterations, allowed == 0 ? kMaxEpaIterations : allowed);
    EXPECT_LE(found.depth, last);
    EXPECT_LT(found.least_depth, found.depth);
    const double along =
        test::separation_along(found.normal, pair.a, pair.pose_a, pair.b, pair.pose_b);
    EXPECT_NEAR(along, -found.depth, 1e-14);
    last = found.depth;
  }
  EXPECT_NEAR(last, 1.99, 0.02);
}

TEST(Epa, ALooseToleranceEndsItEarlierAndBoundsTheError) {
  const PairCase<double> pair = balls_in_each_other();
  PenetrationOptions<double> options;
  options.tolerance = 0.03;
  const auto found = penetration_of(PenetrationMethod::Epa, pair, options);
  EXPECT_EQ(found.status, PenetrationStatus::Converged);
  EXPECT_LT(found.iterations, 128);
  // A fraction of the scale, which is the reach of both balls.
  EXPECT_LE(found.depth - found.least_depth, 0.03 * 2.01);
}

TEST(Mpr, EndsInsideItsCapOnEveryPairAndNamesIt) {
  const PairCase<double> balls = balls_in_each_other();
  for (const int allowed : {1, 2, 3, 4, 0}) {
    PenetrationOptions<double> options;
    options.max_iterations = allowed;
    const auto found = penetration_of(PenetrationMethod::Mpr, balls, options);
    EXPECT_LE(found.iterations, allowed == 0 ? kMaxMprIterations : std::max(allowed, 3));
    EXPECT_EQ(found.status,
              allowed == 0 ? PenetrationStatus::Converged : PenetrationStatus::OutOfIterations);
  }
}

TEST(Mpr, OverhangingPlatesLeaveByTheSideTheRayHits) {
  const PairCase<double> pair{make_box(Vec3d(2, 0.1, 2)), at(0, 0, 0), make_box(Vec3d(2, 0.1, 2)),
                              at(1.5, 0.06, 0)};
  const auto by_epa = penetration_of(PenetrationMethod::Epa, pair);
  const auto by_mpr = penetration_of(PenetrationMethod::Mpr, pair);
  EXPECT_NEAR(by_epa.depth, 0.14, 1e-14);
  EXPECT_NEAR(by_epa.normal.y(), 1, 1e-14);
  EXPECT_EQ(by_mpr.status, PenetrationStatus::Converged);
  EXPECT_NEAR(by_mpr.depth, 2.5, 1e-14) << "the known weakness";
  EXPECT_NEAR(by_mpr.normal.x(), 1, 1e-14);
}

TEST(Sampling, NoDirectionIsFartherFromASampleThanItsBound) {
  for (const int count : {6, 7, 12, 33, 100, 256, 1000}) {
    std::vector<Vec3d> directions;
    SamplingDirections spread(count);
    for (int i = 0; i < count; ++i) {
      directions.push_back(spread.next());
      ASSERT_NEAR(directions.back().norm(), 1, 1e-14);
    }
    // The hull's face nearest to the centre is at the largest cap without a point.
    const Hull<double> hull = build_hull(directions);
    double nearest = 1;
    for (const Plane<double>& plane : hull.planes) nearest = std::min(nearest, plane.offset);
    EXPECT_LE(std::acos(nearest), sampling_angle<double>(count)) << count;
    EXPECT_GE(std::acos(nearest), 0.97 * sampling_angle<double>(count)) << count;
  }
}

TEST(Sampling, ItsBoundHoldsAndShrinksWithTheirNumber) {
  Random random(29);
  for (int i = 0; i < 200; ++i) {
    const PairCase<double> pair = test::everyday_pair(random);
    const auto exact = penetration_of(PenetrationMethod::Sat, pair);
    if (!(exact.depth > 1e-6)) continue;
    for (const int samples : {6, 64, 1024}) {
      PenetrationOptions<double> options;
      options.samples = samples;
      options.max_iterations = 1;
      const auto found = penetration_of(PenetrationMethod::Sampling, pair, options);
      ASSERT_TRUE(has_depth(found.status));
      ASSERT_LE(found.least_depth, exact.depth + 1e-14);
      ASSERT_GE(found.depth, exact.depth - 1e-14);
      const double reach = test::length_scale(pair);
      ASSERT_LE(found.depth - exact.depth, reach * sampling_angle<double>(samples));
    }
  }
}

}  // namespace
}  // namespace contactscope
