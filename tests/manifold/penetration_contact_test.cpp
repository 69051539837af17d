#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "core/manifold.h"
#include "manifold/dispatch.h"
#include "query/tolerance.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"
#include "support/minkowski_face.h"

/// Contacts of hulls with a normal from a penetration method instead of the separating axis test.
namespace contactscope {
namespace {

using test::PairCase;
using test::Random;

constexpr PenetrationMethod kDeepMethods[] = {PenetrationMethod::Epa, PenetrationMethod::Mpr,
                                              PenetrationMethod::Sampling};

template <class S> CollideOptions by(PenetrationMethod method) {
  CollideOptions options;
  options.penetration = method;
  return options;
}

template <class S>
Manifold<S> recorded_contact(const PairCase<S>& pair, const CollideOptions& options,
                             trace::Pair& record, const trace::Stages& stages = {}) {
  record.a = "crate";
  record.b = "floor";
  Manifolds<S> manifolds;
  collide(Shape<S>(pair.a), pair.pose_a, Shape<S>(pair.b), pair.pose_b, options, manifolds, nullptr,
          &record, stages);
  return manifolds.empty() ? Manifold<S>() : manifolds.front();
}

/// The same with swapped shapes, processed in the original order.
template <class S>
trace::Pair recorded_swapped(const PairCase<S>& pair, CollideOptions options,
                             const trace::Stages& stages = {}) {
  options.b_first = true;
  trace::Pair record;
  recorded_contact(test::swapped(pair), options, record, stages);
  return record;
}

template <class S> bool equal_contacts(const Manifold<S>& one, const Manifold<S>& other) {
  if (one.normal != other.normal || one.axis != other.axis) return false;
  if (one.points.size() != other.points.size()) return false;
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    if (one.points[i].position != other.points[i].position ||
        one.points[i].separation != other.points[i].separation ||
        one.points[i].id != other.points[i].id) {
      return false;
    }
  }
  return true;
}

template <class S> class PenetrationContact : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(PenetrationContact, Scalars);

TYPED_TEST(PenetrationContact, StackedCubesMatchTheSeparatingAxisTest) {
  using S = TypeParam;
  const PairCase<S> pair = test::stacked_cubes(20 * test::kDegree, 0.05).cast<S>();
  const Manifold<S> expected = test::collide(pair, by<S>(PenetrationMethod::Sat));
  ASSERT_EQ(expected.points.size(), 8u);
  for (const PenetrationMethod method : kDeepMethods) {
    EXPECT_TRUE(equal_contacts(test::collide(pair, by<S>(method)), expected)) << to_string(method);
  }
}

TYPED_TEST(PenetrationContact, CrossedEdgesHaveOnePointOfTheSameEdges) {
  using S = TypeParam;
  const PairCase<S> pair = test::crossed_edges(1, 0.03).cast<S>();
  const Manifold<S> expected = test::collide(pair, by<S>(PenetrationMethod::Sat));
  for (const PenetrationMethod method : kDeepMethods) {
    const Manifold<S> found = test::collide(pair, by<S>(method));
    ASSERT_EQ(found.axis, AxisKind::EdgeEdge) << to_string(method);
    ASSERT_EQ(found.points.size(), 1u);
    EXPECT_EQ(found.points[0].id, expected.points[0].id);
    EXPECT_NEAR(found.points[0].separation, expected.points[0].separation,
                64 * std::numeric_limits<S>::epsilon());
  }
}

TYPED_TEST(PenetrationContact, TouchesWhereTheSeparatingAxisTestDoesAndWithEpaAsDeep) {
  using S = TypeParam;
  Random random(31);
  std::map<std::string, int> fallbacks;
  int overlapping = 0, same_ids = 0, same_pure_ids = 0;
  for (int i = 0; i < 800; ++i) {
    const PairCase<S> pair = test::everyday_pair(random).cast<S>();
    const Manifold<S> expected = test::collide(pair, by<S>(PenetrationMethod::Sat));
    const double depth = -test::deepest(expected);
    const double rounding = 64 * test::length_scale(pair) * std::numeric_limits<S>::epsilon();
    for (const PenetrationMethod method : kDeepMethods) {
      SCOPED_TRACE(std::string(to_string(method)) + " of pair " + std::to_string(i));
      trace::Pair record;
      const Manifold<S> found = recorded_contact(pair, by<S>(method), record);
      ASSERT_TRUE(equal_contacts(found, test::collide(pair, by<S>(method)))) << "watched";
      ASSERT_FALSE(record.cache);
      if (record.penetration) {
        ASSERT_EQ(record.penetration->method, to_string(method));
        ASSERT_EQ(record.sat.has_value(), record.penetration->fallback == "sat");
        if (!record.penetration->fallback.empty())
          ++fallbacks[record.penetration->method + ", " + record.penetration->status];
      }
      if (expected.points.empty() || !(depth > rounding)) continue;
      ASSERT_FALSE(found.points.empty());
      ASSERT_TRUE(record.penetration);
      // The normal of any method separates the hulls by the depth of its contact.
      const PairCase<double> exact = pair.template cast<double>();
      const double along = test::separation_along(found.normal.template cast<double>(), exact.a,
                                                  exact.pose_a, exact.b, exact.pose_b);
      ASSERT_GE(along, -1.06 * record.penetration->depth - 0.01 * pair.a.radius);
      if (method != PenetrationMethod::Epa) continue;
      ++overlapping;
      const double preferred = 0.06 * depth + 0.004 * std::max(pair.a.radius, pair.b.radius);
      ASSERT_NEAR(-test::deepest(found), depth, preferred + rounding);
      same_ids += test::sorted_ids(found) == test::sorted_ids(expected) ? 1 : 0;
      CollideOptions pure = by<S>(method), pure_sat = by<S>(PenetrationMethod::Sat);
      pure.preference = pure_sat.preference = Preference::None;
      same_pure_ids += test::sorted_ids(test::collide(pair, pure)) ==
                               test::sorted_ids(test::collide(pair, pure_sat))
                           ? 1
                           : 0;
    }
  }
  EXPECT_GT(overlapping, 320);
  // The preference considers the faces most parallel to the normal; the axis test considers all.
  EXPECT_GT(same_ids, overlapping * 4 / 5);
  EXPECT_GT(same_pure_ids, overlapping * 98 / 100);
  // EPA falls back if GJK cannot decide whether they touch, and they do not.
  for (const auto& [ending, count] : fallbacks) {
    std::printf("%d fallbacks of %s\n", count, ending.c_str());
    EXPECT_TRUE(ending == "epa, separated" || !ending.starts_with("epa"));
    testing::Test::RecordProperty(ending, count);
  }
}

TYPED_TEST(PenetrationContact, LeavesNothingInACache) {
  using S = TypeParam;
  const PairCase<S> pair = test::stacked_cubes(0.3, 0.05).cast<S>();
  PairCache<S> cache;
  const auto with_cache = [&](PenetrationMethod method) {
    return collide_hull_hull(pair.a, pair.pose_a, pair.b, pair.pose_b, by<S>(method), &cache);
  };
  with_cache(PenetrationMethod::Sat);
  ASSERT_EQ(cache.kind, CachedKind::Features);
  const Manifold<S> found = with_cache(PenetrationMethod::Epa);
  EXPECT_EQ(cache.kind, CachedKind::Empty);
  EXPECT_TRUE(equal_contacts(found, test::collide(pair, by<S>(PenetrationMethod::Epa))));
}

TYPED_TEST(PenetrationContact, SeparationWithinTheMarginUsesTheSeparatingAxisTest) {
  using S = TypeParam;
  const PairCase<S> pair = test::stacked_cubes(0.3, -0.01).cast<S>();
  for (const PenetrationMethod method : kDeepMethods) {
    CollideOptions options = by<S>(method);
    EXPECT_TRUE(test::collide(pair, options).points.empty());
    options.margin = S(0.02);
    trace::Pair record;
    EXPECT_EQ(recorded_contact(pair, options, record).points.size(), 8u);
    EXPECT_FALSE(record.penetration);
    EXPECT_TRUE(record.sat);
    EXPECT_TRUE(record.gjk);
  }
}

TYPED_TEST(PenetrationContact, FallsBackToTheSeparatingAxisTestAndReportsIt) {
  using S = TypeParam;
  // Level cubes so close that GJK cannot decide, but separated by more than EPA's rounding.
  Random random(37);
  int fallbacks = 0;
  for (int i = 0; i < 400; ++i) {
    PairCase<double> kiss{test::cube(0.5), {random.rotation(), Vec3d::Zero()}, test::cube(0.5), {}};
    kiss.pose_b.rotation = kiss.pose_a.rotation;
    kiss.pose_b.position = kiss.pose_a.rotate(Vec3d(1, 0.2, 0.1)) *
                           (1 + 84 * static_cast<double>(std::numeric_limits<S>::epsilon()));
    const PairCase<S> pair = kiss.cast<S>();
    for (const PenetrationMethod method : kDeepMethods) {
      trace::Pair record;
      const Manifold<S> found = recorded_contact(pair, by<S>(method), record);
      if (!record.penetration || record.penetration->fallback.empty()) continue;
      ++fallbacks;
      EXPECT_EQ(record.penetration->fallback, "sat");
      EXPECT_TRUE(equal_contacts(found, test::collide(pair, by<S>(PenetrationMethod::Sat))));
    }
  }
  EXPECT_GT(fallbacks, 400);
}

TYPED_TEST(PenetrationContact, IsRecordedInTheWorldFromFirstToSecond) {
  using S = TypeParam;
  Random random(41);
  int recorded = 0;
  for (int i = 0; i < 100; ++i) {
    const PairCase<S> pair = test::everyday_pair(random).cast<S>();
    for (const PenetrationMethod method : kDeepMethods) {
      trace::Pair record;
      recorded_contact(pair, by<S>(method), record);
      const trace::Pair mirrored = recorded_swapped(pair, by<S>(method));
      ASSERT_EQ(record.penetration.has_value(), mirrored.penetration.has_value());
      if (!record.penetration || !record.penetration->fallback.empty()) continue;
      ++recorded;
      const trace::Penetration& one = *record.penetration;
      const trace::Penetration& other = *mirrored.penetration;
      const double rounding =
          256 * (test::length_scale(pair) + 10) * std::numeric_limits<S>::epsilon();
      ASSERT_NEAR((one.point_a - one.point_b).dot(one.normal), one.depth, rounding);
      ASSERT_EQ(other.normal, -one.normal);
      ASSERT_EQ(other.point_a, one.point_b);
      ASSERT_EQ(other.depth, one.depth);
      ASSERT_EQ(other.polytopes.size(), one.polytopes.size());
      for (const trace::Penetration& each : {one, other}) {
        ASSERT_EQ(each.polytopes.empty(), method != PenetrationMethod::Epa);
        for (const trace::Polytope& polytope : each.polytopes) {
          const std::array<int, 3>& face =
              polytope.faces[static_cast<std::size_t>(polytope.nearest)];
          Vec3d corners[3];
          for (std::size_t k = 0; k < 3; ++k) {
            const auto& vertex = polytope.vertices[static_cast<std::size_t>(face[k])];
            corners[k] = vertex.b - vertex.a;
          }
          const Vec3d side1 = corners[1] - corners[0], side2 = corners[2] - corners[0];
          const Vec3d cross = side1.cross(side2);
          if (cross.norm() < 0.01 * side1.norm() * side2.norm()) continue;
          ASSERT_GE(cross.normalized().dot(corners[0]), -100 * rounding) << "outward";
        }
        for (const trace::Simplex& portal : each.portals) ASSERT_EQ(portal.size(), 4u);
      }
      if (method == PenetrationMethod::Sampling) {
        double best = -std::numeric_limits<double>::infinity();
        for (const trace::SampledDirection& tried : one.directions) {
          best = std::max(best, tried.separation);
        }
        ASSERT_NEAR(best, -one.depth, rounding);
      }
    }
  }
  EXPECT_GT(recorded, 100);
}

TEST(MinkowskiRecord, ItsNearestFaceIsTheDepthAndItsEdgePairsHoldTheBestAxis) {
  trace::Stages stages;
  stages.minkowski = stages.gauss_map = true;
  Random random(43);
  int overlapping = 0, by_edges = 0;
  for (int i = 0; i < 120; ++i) {
    const PairCase<double> pair = test::everyday_pair(random);
    if (pair.a.vertex_count() * pair.b.vertex_count() > 400) continue;
    const auto truth = test::brute_force_sat(pair.a, pair.pose_a, pair.b, pair.pose_b);
    if (!(truth.separation < -1e-3)) continue;
    ++overlapping;
    for (const bool mirrored : {false, true}) {
      trace::Pair record;
      if (mirrored)
        record = recorded_swapped(pair, {}, stages);
      else
        recorded_contact(pair, {}, record, stages);
      ASSERT_TRUE(record.minkowski) << i;
      double nearest = std::numeric_limits<double>::infinity();
      Vec3d offset = Vec3d::Zero();
      for (const std::vector<int>& face : record.minkowski->faces) {
        const auto at = [&](std::size_t k) -> const Vec3d& {
          return record.minkowski->vertices[static_cast<std::size_t>(face[k])];
        };
        const Vec3d side1 = at(1) - at(0), side2 = at(2) - at(0);
        const Vec3d cross = side1.cross(side2);
        if (cross.norm() < 1e-3 * side1.norm() * side2.norm()) continue;
        const Vec3d outward = cross.normalized();
        if (outward.dot(at(0)) < nearest) nearest = outward.dot(at(0)), offset = outward;
      }
      ASSERT_NEAR(nearest, -truth.separation, 1e-5) << i;
      EXPECT_NEAR(offset.dot(truth.normal), mirrored ? 1 : -1, 1e-3) << i;

      ASSERT_TRUE(record.sat);
      double best = -std::numeric_limits<double>::infinity();
      for (const trace::EdgePair& edges : record.sat->edge_pairs) {
        best = std::max(best, edges.separation);
        ASSERT_NEAR(edges.normal.norm(), 1, 1e-12);
      }
      ASSERT_TRUE(record.sat->edge);
      ASSERT_NEAR(best, record.sat->edge->separation, 1e-12);
      ASSERT_LE(best, truth.separation + 1e-12);
      by_edges += std::abs(best - truth.separation) < 1e-12 ? 1 : 0;
    }
  }
  EXPECT_GT(overlapping, 15);
  EXPECT_GT(by_edges, 5);
}

TEST(MinkowskiRecord, IsOmittedByDefaultAndWhereItIsLarge) {
  const PairCase<double> small = test::stacked_cubes(0.3, 0.05);
  trace::Pair unasked;
  recorded_contact(small, {}, unasked);
  EXPECT_FALSE(unasked.minkowski);
  EXPECT_TRUE(unasked.sat->edge_pairs.empty());

  trace::Stages stages;
  stages.minkowski = true;
  Random random(47);
  const PairCase<double> large{test::random_hull(random, 80, 1, 1), test::at(0, 0, 0),
                               test::random_hull(random, 64, 1, 1), test::at(0.2, 0, 0)};
  trace::Pair refused;
  EXPECT_FALSE(recorded_contact(large, {}, refused, stages).points.empty());
  EXPECT_FALSE(refused.minkowski);
}

TEST(CrossingEdgePairs, AreThoseOfTheGaussMapTest) {
  Random random(53);
  for (int i = 0; i < 40; ++i) {
    const PairCase<double> pair = test::everyday_pair(random);
    const HullPair<double> placed(pair.a, pair.b, relative_pose(pair.pose_a, pair.pose_b));
    FaceSeparations<double> faces_a(placed.a);
    query_faces(placed.a, placed.b, 0.0, faces_a);
    std::size_t requested = 0, close_calls = 0;
    for (int a = 0; a < 2 * pair.a.edge_count(); a += 2) {
      for (int b = 0; b < 2 * pair.b.edge_count(); b += 2) {
        const Vec3d a1 = placed.a.normal(placed.a.half_edge(a).face);
        const Vec3d a2 = placed.a.normal(placed.a.half_edge(a + 1).face);
        const Vec3d b1 = placed.b.normal(placed.b.half_edge(b).face);
        const Vec3d b2 = placed.b.normal(placed.b.half_edge(b + 1).face);
        requested += test::is_minkowski_face(a1, a2, b1, b2) ? 1 : 0;
        // Arcs that end on the other arc may be decided by rounding.
        const Vec3d of_a = a1.cross(a2), of_b = b1.cross(b2);
        for (const double side : {of_b.dot(a1), of_b.dot(a2), of_a.dot(b1), of_a.dot(b2)}) {
          close_calls += std::abs(side) < 1e-12 ? 1 : 0;
        }
      }
    }
    if (close_calls > 0) continue;
    EXPECT_EQ(all_crossings(placed, faces_a).size(), requested) << i;
  }
}

}  // namespace
}  // namespace contactscope
