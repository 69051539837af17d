#include <gtest/gtest.h>

#include <string>

#include "core/convex_polygon.h"
#include "geometry/mesh.h"
#include "manifold/create_contact.h"
#include "manifold/pair_cache.h"
#include "manifold/placed_shapes.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"

// Hulls whose coplanar faces were not merged: clipping sees one triangle of each face. Gregorius
// 2015, "Hull vs Hull: Coplanar Faces".
namespace contactscope {
namespace {

using test::about;
using test::at;
using test::deepest;
using test::PairCase;
using test::Random;

PairCase<double> unmerged(const PairCase<double>& pair) {
  return {triangulate_faces(pair.a), pair.pose_a, triangulate_faces(pair.b), pair.pose_b};
}

/// A box, or a prism or pyramid over a polygon, standing on a face.
Hull<double> random_block(Random& random) {
  const int kind = random.index(4);
  if (kind == 0) return make_cylinder(random.uniform(0.2, 1), 0.3, 3 + random.index(20));
  if (kind == 1) return make_cone(random.uniform(0.2, 1), 0.3, 3 + random.index(20));
  return make_box(random.vector(0.1, 1));
}

/// The upper block stands on the lower one, level or tilted by up to 0.1 rad. Half of the pairs are
/// moved elsewhere, so that rounding affects the ties.
PairCase<double> standing_pair(Random& random) {
  PairCase<double> pair{make_box(Vec3d(random.uniform(0.3, 1), 0.5, random.uniform(0.3, 1))),
                        at(0, 0, 0), random_block(random), at(0, 0, 0)};
  const double tilt = random.chance(0.3) ? 0 : random.decade(-9, -1);
  const Vec3d sideways = random.unit_vector();
  pair.pose_b.rotation = about(Vec3d::UnitY(), random.uniform(0, 7)) *
                         about(Vec3d(sideways.x(), 0, sideways.z()), tilt);
  double lowest = 0;
  for (const Vec3d& vertex : pair.b.vertices) {
    lowest = std::min(lowest, pair.pose_b.rotate(vertex).y());
  }
  const double depth = random.decade(-4, -1);
  pair.pose_b.position = random.level(1, 0.5 - depth - lowest);
  return random.chance(0.5) ? pair : test::moved(pair, random.pose(5));
}

/// Number of points that clipping alone finds for the chosen face of A or B; -1 for an edge pair.
template <class S> int points_of_clipping(const PairCase<S>& pair, Preference preference) {
  const HullPair<S> placed(pair.a, pair.b, relative_pose(pair.pose_a, pair.pose_b));
  const SatResult<S> axes = sat(placed, S(0), preference);
  if (axes.status != SatStatus::Touching || axes.chosen == AxisKind::EdgeEdge) return -1;
  const bool on_a = axes.chosen == AxisKind::FaceA;
  Contact<S> contact;
  create_face_contact<S>(placed, on_a ? Owner::A : Owner::B, on_a ? axes.face_a : axes.face_b, S(0),
                         contact, nullptr);
  return static_cast<int>(contact.points.size());
}

template <class S> double area_seen_from_above(const Manifold<S>& manifold) {
  std::vector<Vec2d> seen;
  for (const ContactPoint<S>& point : manifold.points) {
    seen.emplace_back(static_cast<double>(point.position.z()),
                      static_cast<double>(point.position.x()));
  }
  return area_of(convex_polygon(seen));
}

template <class S> class Coplanar : public testing::Test {
 protected:
  static constexpr double kEpsilon = std::numeric_limits<S>::epsilon();
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Coplanar, Scalars);

TYPED_TEST(Coplanar, UnmergedFacesLeaveTheTalksUnstableTriangle) {
  using S = TypeParam;
  const PairCase<double> pair = test::stacked_cubes(0, 0.01);
  const Manifold<S> whole = test::collide(pair.cast<S>());
  const Manifold<S> part = test::collide(unmerged(pair).cast<S>());
  ASSERT_EQ(whole.points.size(), 4u);
  ASSERT_EQ(part.points.size(), 3u);
  EXPECT_NEAR(area_seen_from_above(whole), 1, 8 * this->kEpsilon);
  EXPECT_NEAR(area_seen_from_above(part), 0.5, 8 * this->kEpsilon);
  EXPECT_NEAR(deepest(part), -0.01, 8 * this->kEpsilon);
  EXPECT_GT(part.normal.y(), S(0.999999));
}

TYPED_TEST(Coplanar, TrianglesThatDoNotMeetStillGiveAPoint) {
  using S = TypeParam;
  // The upper cube is off the lower cube's first upper triangle, so clipping leaves nothing.
  PairCase<double> pair = test::stacked_cubes(0, 0.01);
  pair.b = test::cube(0.1);
  pair.pose_b = at(0.3, 0.59, 0.3);
  const PairCase<S> cut = unmerged(pair).cast<S>();
  ASSERT_EQ(points_of_clipping(cut, Preference::Relative), 0);
  const Manifold<S> manifold = test::collide(cut);
  ASSERT_EQ(manifold.points.size(), 1u);
  EXPECT_EQ(manifold.type, ContactType::PointFace);
  EXPECT_NEAR(deepest(manifold), -0.01, 8 * this->kEpsilon);
  EXPECT_NEAR(static_cast<double>(manifold.points[0].position.y()), 0.5, 8 * this->kEpsilon);
  EXPECT_GE(manifold.points[0].position.x(), S(0.2) - S(1e-6));
  EXPECT_EQ(test::collide(pair.cast<S>()).points.size(), 4u);
}

TYPED_TEST(Coplanar, SlowUnmergedHullsAlwaysHaveContactWithTheBruteForceDepth) {
  using S = TypeParam;
  Random random(20150303);
  int touching = 0;
  int lost_by_clipping = 0;
  int fewer_points = 0;
  for (int i = 0; i < 4000; ++i) {
    SCOPED_TRACE("pair " + std::to_string(i));
    const bool stands = !random.chance(0.25);
    const PairCase<double> given = stands ? standing_pair(random) : test::everyday_pair(random);
    const PairCase<S> pair = unmerged(given).template cast<S>();
    const PairCase<double> exact = pair.template cast<double>();
    const double best =
        test::brute_force_sat(exact.a, exact.pose_a, exact.b, exact.pose_b).separation;
    const double rounding = 64 * test::length_scale(exact) * this->kEpsilon;
    if (best > -rounding) continue;
    ++touching;
    for (const Preference preference : {Preference::Relative, Preference::None}) {
      CollideOptions options;
      options.preference = preference;
      const Manifold<S> manifold = test::collide(pair, options);
      const double smaller = std::min(exact.a.radius, exact.b.radius);
      const double allowed = preference == Preference::Relative
                                 ? std::max(0.05 * -best, 0.002 * smaller) + rounding
                                 : rounding;
      ASSERT_FALSE(manifold.points.empty());
      ASSERT_NEAR(deepest(manifold), best, allowed);
      if (points_of_clipping(pair, preference) == 0) ++lost_by_clipping;
      const Manifold<S> whole = test::collide(given.template cast<S>(), options);
      if (manifold.points.size() < whole.points.size()) ++fewer_points;
    }
  }
  EXPECT_GT(touching, 2000);
  EXPECT_GT(lost_by_clipping, 200);  // create_contact must make up for these
  EXPECT_GT(fewer_points, 1000);
}

TYPED_TEST(Coplanar, ACachedContactOfUnmergedHullsIsNeverEmptyEither) {
  using S = TypeParam;
  const Hull<S> block = hull_cast<S>(triangulate_faces(test::cube(0.5)));
  PairCache<S> cache;
  for (int step = 0; step < 400; ++step) {
    const double angle = 0.02 * step;
    Pose<double> pose = at(0.3 * std::cos(2 * angle), 0.99, 0.3 * std::sin(2 * angle));
    pose.rotation = about(Vec3d::UnitY(), 0.3 * angle) *
                    about(Vec3d(std::cos(angle), 0, std::sin(angle)), 0.002);
    const Manifold<S> manifold = collide_hull_hull(block, at(0, 0, 0).cast<S>(), block,
                                                   pose.cast<S>(), CollideOptions(), &cache);
    ASSERT_FALSE(manifold.points.empty()) << step;
    ASSERT_GT(manifold.normal.y(), S(0.99)) << step;
    // A corner is up to 0.71 m from the middle, and the tilt is 0.002 rad.
    ASSERT_NEAR(deepest(manifold), -0.01, 0.0015) << step;
  }
}

TYPED_TEST(Coplanar, SlowSpheresCapsulesAndPlanesFeelNoCutInAFace) {
  using S = TypeParam;
  Random random(8);
  int touching = 0;
  for (int i = 0; i < 3000; ++i) {
    SCOPED_TRACE("pair " + std::to_string(i));
    const Hull<double> block = random_block(random);
    const double radius = random.uniform(0.02, 0.3);
    const Shape<double> rounds[] = {test::ball(radius), test::lying_capsule(0.4, radius),
                                    test::ground()};
    for (const Shape<double>& other : rounds) {
      const Pose<double> placed = {
          random.chance(0.5) ? Quatd(Quatd::Identity()) : random.rotation(),
          random.uniform(0.2, 1.2) * random.unit_vector()};
      const test::PlacedShapes merged = test::rounded<S>({other, at(0, 0, 0), block, placed});
      test::PlacedShapes cut = merged;
      cut.b = triangulate_faces(std::get<Hull<double>>(merged.b));
      const Manifold<S> whole = test::manifold_of<S>(merged);
      const Manifold<S> part = test::manifold_of<S>(cut);
      ASSERT_EQ(part.points.empty(), whole.points.empty());
      if (whole.points.empty()) continue;
      ++touching;
      ASSERT_NEAR(test::deepest_of(part), test::deepest_of(whole), 64 * this->kEpsilon);
      ASSERT_LT((test::normal_of(part) - test::normal_of(whole)).norm(), 1e-3);
    }
  }
  EXPECT_GT(touching, 2000);
}

}  // namespace
}  // namespace contactscope
