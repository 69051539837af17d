#include "manifold/incremental.h"

#include <gmock/gmock.h>

#include <set>

#include "geometry/core_hull.h"
#include "geometry/primitives.h"
#include "manifold/placed_shapes.h"
#include "support/brute_force_distance.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"
#include "support/random_geometry.h"

namespace contactscope::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A pair that is stepped frame by frame, with poses from the test.
template <class S> class Stepped {
 public:
  Stepped(const Shape<double>& a, const Shape<double>& b, const IncrementalSettings& settings = {})
      : a_(shape_cast<S>(a)), b_(shape_cast<S>(b)) {
    incremental_.settings = settings;
    options_.reducer = find_reducer("area");
  }
  /// The manifold of the next frame; it has no points if there is none.
  Manifold<S> step(const Pose<double>& pose_a, const Pose<double>& pose_b) {
    Manifolds<S> manifolds;
    collide_incremental(a_, pose_a.template cast<S>(), b_, pose_b.template cast<S>(), options_,
                        incremental_, persistent_, manifolds);
    return manifolds.empty() ? Manifold<S>() : manifolds.front();
  }
  trace::Pair record(const Pose<double>& pose_a, const Pose<double>& pose_b) {
    Manifolds<S> manifolds;
    trace::Pair pair;
    collide_incremental(a_, pose_a.template cast<S>(), b_, pose_b.template cast<S>(), options_,
                        incremental_, persistent_, manifolds, &pair);
    return pair;
  }
  CollideOptions& options() { return options_; }
  IncrementalOptions& incremental() { return incremental_; }
  const PersistentManifold<S>& persistent() const { return persistent_; }

 private:
  Shape<S> a_, b_;
  CollideOptions options_;
  IncrementalOptions incremental_;
  PersistentManifold<S> persistent_;
};

Shape<double> box(double x, double y, double z) { return make_box(Vec3d(x, y, z)); }

IncrementalSettings scaled(double scale, Confirm confirm = Confirm::Distance) {
  return {confirm, 0.02 * scale, 0.02 * scale};
}

template <class S> class Incremental : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Incremental, Scalars);

TYPED_TEST(Incremental, ALevelBoxThatSinksGetsItsFourCornersInFourFrames) {
  using S = TypeParam;
  const double rounding = 16 * std::numeric_limits<S>::epsilon();
  Stepped<S> pair(box(0.5, 0.5, 0.5), box(2, 0.5, 2));
  for (int frame = 0; frame < 8; ++frame) {
    const double depth = 0.001 * (frame + 1);
    const Manifold<S> manifold = pair.step(at(0.1, 1 - depth, 0.2), at(0, 0, 0));
    ASSERT_EQ(manifold.points.size(), static_cast<std::size_t>(std::min(frame + 1, 4)));
    EXPECT_EQ(manifold.axis, AxisKind::ClosestPoints);
    EXPECT_EQ(normal_of(manifold), Vec3d(0, -1, 0));
    for (std::size_t i = 0; i < manifold.points.size(); ++i) {
      EXPECT_NEAR(manifold.points[i].separation, -depth, rounding);
      // Inside the corner by the margin, midway between the two surfaces.
      const Vec3d place = position_of(manifold, i) - Vec3d(0.1, 0.5 - 0.5 * depth, 0.2);
      EXPECT_NEAR(std::abs(place.x()), 0.48, rounding);
      EXPECT_NEAR(std::abs(place.z()), 0.48, rounding);
      EXPECT_NEAR(place.y(), 0, rounding);
    }
    if (frame == 1) {  // across the diagonal
      EXPECT_NEAR((position_of(manifold, 0) - position_of(manifold, 1)).norm(),
                  0.96 * std::sqrt(2.0), 1e-3);
    }
  }
  std::vector<int> ages;
  for (const auto& point : pair.persistent().points) ages.push_back(point.age);
  EXPECT_THAT(ages, ElementsAre(7, 6, 5, 4));
}

TYPED_TEST(Incremental, SlidingBreaksPointsByDistanceAndKeepsThemByIds) {
  using S = TypeParam;
  for (const Confirm confirm : {Confirm::Distance, Confirm::Ids}) {
    Stepped<S> pair(box(0.5, 0.5, 0.5), box(2, 0.5, 2), scaled(1, confirm));
    for (int frame = 0; frame < 4; ++frame) pair.step(at(0, 0.995, 0), at(0, 0, 0));
    const std::vector<std::string> before = ids_of(pair.step(at(0, 0.995, 0), at(0, 0, 0)));
    ASSERT_EQ(before.size(), 4U);
    std::set<std::string> reasons;
    std::size_t fewest = 4;
    Manifold<S> manifold;
    for (int frame = 1; frame <= 20; ++frame) {
      const trace::Pair recorded = pair.record(at(0.015 * frame, 0.995, 0), at(0, 0, 0));
      for (const auto& point : recorded.incremental->points)
        if (point.state == "broken") reasons.insert(point.reason);
      fewest = std::min(fewest, recorded.manifolds.at(0).points.size());
      for (const trace::Point& point : recorded.manifolds.at(0).points)
        EXPECT_NEAR(point.separation, -0.005, 1e-6);
    }
    if (confirm == Confirm::Distance) {
      EXPECT_THAT(reasons, ::testing::Contains("slid"));
      EXPECT_LT(fewest, 4U);
      continue;
    }
    EXPECT_EQ(fewest, 4U);
    EXPECT_THAT(reasons, IsEmpty());
    manifold = pair.step(at(0.3, 0.995, 0), at(0, 0, 0));
    EXPECT_EQ(ids_of(manifold), before);
    for (std::size_t i = 0; i < 4; ++i)  // and have moved with the box
      EXPECT_NEAR(std::abs(position_of(manifold, i).x() - 0.3), 0.48, 1e-5);
  }
}

TYPED_TEST(Incremental, APointOverTheEdgeNoLongerFacesItsFeature) {
  using S = TypeParam;
  Stepped<S> pair(box(0.5, 0.5, 0.5), box(1, 0.5, 1), scaled(1, Confirm::Ids));
  for (int frame = 0; frame < 4; ++frame) pair.step(at(0.45, 0.995, 0), at(0, 0, 0));
  const trace::Pair recorded = pair.record(at(0.51, 0.995, 0), at(0, 0, 0));
  std::vector<std::string> reasons;
  for (const auto& point : recorded.incremental->points)
    if (point.state == "broken") reasons.push_back(point.reason);
  EXPECT_THAT(reasons, ElementsAre("other features", "other features"));
}

TYPED_TEST(Incremental, APointTooCloseToAnOldOneReplacesItAndTakesItsName) {
  using S = TypeParam;
  // A sphere moves sideways and turns, so that its own place moves too.
  Stepped<S> pair(ball(0.5), box(2, 0.5, 2));
  const Manifold<S> first = pair.step(at(0, 0.99, 0), at(0, 0, 0));
  ASSERT_EQ(first.points.size(), 1U);
  const trace::Pair recorded = pair.record(at(0.012, 0.99, 0), at(0, 0, 0));
  ASSERT_EQ(recorded.incremental->points.size(), 2U);
  EXPECT_EQ(recorded.incremental->points[0].state, "persisted");
  EXPECT_EQ(recorded.incremental->points[0].age, 1);
  EXPECT_NEAR(recorded.incremental->points[0].point.position.x(), 0.012, 1e-6);
  EXPECT_EQ(recorded.incremental->points[0].point.id, to_string(first.points[0].id));
  EXPECT_EQ(recorded.incremental->points[1].reason, "replaced");

  // A corner passes the floor's border: other features at about the same place keep the name.
  Stepped<S> leaving(box(0.5, 0.5, 0.5), box(2, 0.5, 2));
  const Quatd turn = about(Vec3d::UnitZ(), 0.7) * about(Vec3d::UnitX(), 0.6);
  Vec3d corner = Vec3d::Zero();  // of the core
  for (const Vec3d& v : make_box(Vec3d(0.48, 0.48, 0.48)).vertices)
    if ((turn * v).y() < corner.y()) corner = turn * v;
  const auto over = [&](double x) {  // the core's corner over the floor's core, which ends at 1.98
    return Pose<double>{turn, Vec3d(x, 0.51, 0) - corner};
  };
  const std::string name = ids_of(leaving.step(over(1.975), at(0, 0, 0))).at(0);
  EXPECT_EQ(to_string(leaving.persistent().points[0].found), name);
  EXPECT_THAT(ids_of(leaving.step(over(1.985), at(0, 0, 0))), ElementsAre(name));
  EXPECT_NE(to_string(leaving.persistent().points[0].found), name);
}

TYPED_TEST(Incremental, OverlappingCoresHaveTheDepthOfTheSeparatingAxisTest) {
  using S = TypeParam;
  Random random(11);
  int deep = 0;
  for (int i = 0; i < 300; ++i) {
    const double size = random.decade(-3, 3);
    const Hull<double> a = random_box(random, size, 3), b = random_hull(random, 12, size, 3);
    const Pose<double> pose_a{random.rotation(), Vec3d::Zero()};
    const Pose<double> pose_b{random.rotation(),
                              size * random.uniform(0, 0.6) * random.unit_vector()};
    Stepped<S> pair(a, b, scaled(size));
    const trace::Pair recorded = pair.record(pose_a, pose_b);
    ASSERT_TRUE(recorded.incremental);
    if (recorded.incremental->query != "sat") continue;
    ++deep;
    const CoreHull core_a = core_hull(a, 0.02 * size), core_b = core_hull(b, 0.02 * size);
    const BruteForceAxis axis = brute_force_sat(core_a.hull, pose_a, core_b.hull, pose_b);
    ASSERT_EQ(recorded.manifolds.size(), 1U);
    EXPECT_NEAR(recorded.manifolds[0].points.at(0).separation,
                axis.separation - core_a.margin - core_b.margin,
                (sizeof(S) == 4 ? 2e-5 : 1e-6) * size)
        << i;
  }
  EXPECT_GT(deep, 200);
}

TYPED_TEST(Incremental, ShallowPointsAreTheDistanceOfTheCoresLessTheMargins) {
  using S = TypeParam;
  Random random(12);
  for (int i = 0; i < 150; ++i) {
    const double size = random.decade(-4, 4);
    const Hull<double> a = random_box(random, size, 3), b = random_hull(random, 10, size, 3);
    const Pose<double> pose_a{random.rotation(), Vec3d::Zero()};
    const Pose<double> pose_b{random.rotation(), 1.5 * size * random.unit_vector()};
    Stepped<S> pair(a, b, {Confirm::Distance, 0.05 * size, 0.02 * size});
    pair.options().margin = static_cast<S>(10 * size);  // every pair has a point
    const Manifold<S> manifold = pair.step(pose_a, pose_b);
    const CoreHull core_a = core_hull(a, 0.05 * size), core_b = core_hull(b, 0.05 * size);
    const double distance = static_cast<double>(
        brute_force_distance(features_of(core_a.hull, pose_a), features_of(core_b.hull, pose_b))
            .distance);
    if (distance == 0) continue;
    ASSERT_EQ(manifold.points.size(), 1U) << i;
    EXPECT_NEAR(manifold.points[0].separation, distance - core_a.margin - core_b.margin,
                (sizeof(S) == 4 ? 2e-5 : 1e-6) * size)
        << i;
  }
}

/// Ids of every frame of a box that lands on a corner and settles.
template <class S>
std::vector<std::vector<std::string>> landing(double scale, const Pose<double>& moved_by) {
  Stepped<S> pair(box(0.5 * scale, 0.3 * scale, 0.4 * scale),
                  box(2 * scale, 0.5 * scale, 2 * scale), scaled(scale));
  std::vector<std::vector<std::string>> ids;
  for (int frame = 0; frame < 12; ++frame) {
    const double tilt = std::max(0.0, 0.02 - 0.004 * frame);
    const Quatd turn = about(Vec3d::UnitY(), 0.5) * about(Vec3d(1, 0, 0.7), tilt);
    double lowest = 0;
    for (const Vec3d& v : make_box(Vec3d(0.5, 0.3, 0.4)).vertices)
      lowest = std::min(lowest, (turn * v).y());
    Pose<double> pose{turn, scale * Vec3d(0.1, 0.5 - lowest - 0.004, 0.1)};
    Pose<double> floor = compose(moved_by, at(0, 0, 0));
    pose = compose(moved_by, pose);
    pose.rotation.normalize();
    floor.rotation.normalize();
    ids.push_back(ids_of(pair.step(pose, floor)));
  }
  return ids;
}

TYPED_TEST(Incremental, TheOutcomeIsTheSameFromATenthOfAMillimetreToTenKilometres) {
  using S = TypeParam;
  const auto expected = landing<S>(1, {});
  EXPECT_EQ(expected.back().size(), 4U);
  for (const double scale : {1e-4, 1e-2, 1e2, 1e4}) EXPECT_EQ(landing<S>(scale, {}), expected);
}

TYPED_TEST(Incremental, RigidMotionsDoNotChangeTheOutcome) {
  using S = TypeParam;
  const auto expected = landing<S>(1, {});
  Random random(13);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(landing<S>(1, random.pose(2)), expected) << i;
}

TYPED_TEST(Incremental, EveryKindOfPairHasOnePointAtItsSurfaces) {
  using S = TypeParam;
  struct Case {
    Shape<double> a, b;
    double height;  // of a's frame above b's when they touch
    std::size_t points;
  };
  const std::vector<Case> cases{{ball(0.5), ball(0.3), 0.8, 1},
                                {ball(0.5), lying_capsule(0.4, 0.3), 0.8, 1},
                                {ball(0.5), box(1, 0.2, 1), 0.7, 1},
                                {ball(0.5), ground(), 0.5, 1},
                                {lying_capsule(0.4, 0.5), lying_capsule(0.6, 0.3), 0.8, 2},
                                {lying_capsule(0.4, 0.5), box(1, 0.2, 1), 0.7, 2},
                                {lying_capsule(0.4, 0.5), ground(), 0.5, 2},
                                {box(0.5, 0.5, 0.5), box(1, 0.2, 1), 0.7, 4},
                                {box(0.5, 0.5, 0.5), ground(), 0.5, 4}};
  for (const Case& c : cases) {
    Stepped<S> pair(c.a, c.b), swapped(c.b, c.a);
    for (int frame = 0; frame < 6; ++frame) {
      const Pose<double> upper = at(0, c.height - 0.01, 0);
      const Manifold<S> manifold = pair.step(upper, at(0, 0, 0));
      EXPECT_EQ(normal_of(manifold), Vec3d(0, -1, 0)) << c.a.index() << c.b.index();
      for (const auto& point : manifold.points) EXPECT_NEAR(point.separation, -0.01, 1e-6);
      EXPECT_EQ(manifold.points.size(), std::min<std::size_t>(c.points, frame + 1));
      if (c.a.index() == c.b.index()) continue;
      Manifold<S> other = swapped.step(at(0, 0, 0), upper);
      mirror(other);
      EXPECT_EQ(ids_of(other), ids_of(manifold));
      EXPECT_EQ(other.normal, manifold.normal);
      for (std::size_t i = 0; i < manifold.points.size(); ++i)
        EXPECT_EQ(other.points[i].position, manifold.points[i].position);
    }
  }
}

TYPED_TEST(Incremental, WhileThingsTumbleIdsAreOnceEachAndARecordChangesNothing) {
  using S = TypeParam;
  Random random(14);
  for (const Confirm confirm : {Confirm::Distance, Confirm::Ids}) {
    for (int i = 0; i < 30; ++i) {
      const Shape<double> a =
          i % 3 == 0 ? lying_capsule(0.3, 0.2) : Shape<double>(random_hull(random, 14, 0.5, 2));
      Stepped<S> pair(a, box(2, 0.5, 2), scaled(1, confirm)),
          watched(a, box(2, 0.5, 2), scaled(1, confirm));
      const Vec3d axis = random.unit_vector(), offset = random.unit_vector();
      const Quatd start = random.rotation();
      for (int frame = 0; frame < 60; ++frame) {
        const Pose<double> pose{about(axis, 0.01 * frame) * start,
                                Vec3d(0, 0.8, 0) + 0.004 * frame * offset};
        const Manifold<S> manifold = pair.step(pose, at(0, 0, 0));
        const trace::Pair recorded = watched.record(pose, at(0, 0, 0));
        ASSERT_LE(manifold.points.size(), 4U);
        ASSERT_TRUE(is_finite(manifold));
        const std::vector<std::string> ids = ids_of(manifold);
        EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), ids.size()) << i;
        ASSERT_EQ(recorded.manifolds.size(), manifold.points.empty() ? 0U : 1U);
        for (std::size_t k = 0; k < ids.size(); ++k) {
          EXPECT_EQ(recorded.manifolds[0].points.at(k).position, position_of(manifold, k));
          EXPECT_EQ(recorded.manifolds[0].points[k].separation,
                    static_cast<double>(manifold.points[k].separation));
          EXPECT_EQ(recorded.manifolds[0].points[k].id, ids[k]);
          EXPECT_EQ(recorded.incremental->points.at(k).point.id, ids[k]);
        }
      }
    }
  }
}

TEST(IncrementalManifold, IsLeftBehindWhenTheShapesPart) {
  Stepped<double> pair(box(0.5, 0.5, 0.5), box(2, 0.5, 2));
  for (int frame = 0; frame < 4; ++frame) pair.step(at(0, 0.995, 0), at(0, 0, 0));
  EXPECT_EQ(pair.step(at(0, 1.015, 0), at(0, 0, 0)).points.size(),
            4U);  // up to the breaking distance
  const trace::Pair recorded = pair.record(at(0, 1.025, 0), at(0, 0, 0));
  EXPECT_EQ(recorded.state, "separated");
  EXPECT_NEAR(recorded.separation, 0.025, 1e-12);
  ASSERT_EQ(recorded.incremental->points.size(), 4U);
  for (const auto& point : recorded.incremental->points) EXPECT_EQ(point.reason, "apart");
  EXPECT_TRUE(pair.persistent().points.empty());
}

TEST(IncrementalManifold, SwappingTheShapesMirrorsTheRecord) {
  Stepped<double> pair(box(0.5, 0.5, 0.5), ground()), swapped(ground(), box(0.5, 0.5, 0.5));
  const trace::Pair recorded = pair.record(at(0, 0.49, 0), at(0, 0, 0));
  const trace::Pair other = swapped.record(at(0, 0, 0), at(0, 0.49, 0));
  EXPECT_EQ(recorded.incremental->query, "plane");
  EXPECT_EQ(recorded.incremental->margin_a, other.incremental->margin_b);
  EXPECT_EQ(recorded.incremental->margin_a, 0.02);
  EXPECT_EQ(recorded.incremental->points.at(0).on_a(), other.incremental->points.at(0).on_b());
  EXPECT_EQ(other.incremental->points[0].point.id.substr(0, 4), "a:f0");
  EXPECT_EQ(other.manifolds.at(0).normal, Vec3d(0, 1, 0));
}

TEST(IncrementalManifold, AThinShapeHasASmallerMargin) {
  Stepped<double> pair(box(0.5, 0.01, 0.5), box(2, 0.5, 2));
  const trace::Pair recorded = pair.record(at(0, 0.509, 0), at(0, 0, 0));
  EXPECT_NEAR(recorded.incremental->margin_a, 0.005, 1e-15);
  EXPECT_EQ(recorded.incremental->margin_b, 0.02);
  EXPECT_NEAR(recorded.manifolds.at(0).points.at(0).separation, -0.001, 1e-12);
}

/// Level on the floor, 5 mm deep: all corners are equally good.
Pose<double> standing(double turn = 0) { return {about(Vec3d::UnitY(), turn), Vec3d(0, 0.995, 0)}; }

TEST(IncrementalManifold, EveryReducerLeavesFourPointsOfAPrismWithManyCorners) {
  for (const ReducerInfo& info : reducers()) {
    Stepped<double> pair(make_cylinder(0.5, 0.5, 24), box(2, 0.5, 2),
                         {Confirm::Distance, 0.02, 1e-3});
    pair.options().reducer = find_reducer(info.name);
    ASSERT_EQ(pair.options().reducer == nullptr, info.name == "none");
    if (info.name == "none") continue;
    std::size_t reduced = 0;
    for (int frame = 0; frame < 40; ++frame) {
      const trace::Pair recorded = pair.record(standing(), at(0, 0, 0));
      std::set<std::string> standing_ids, reduced_ids;
      for (const trace::PersistentPoint& point : recorded.incremental->points) {
        if (point.state == "broken") {
          EXPECT_EQ(point.reason, "reduced") << info.name << ", frame " << frame;
          reduced_ids.insert(point.point.id);
        } else {
          standing_ids.insert(point.point.id);
        }
      }
      EXPECT_LE(standing_ids.size(), std::min<std::size_t>(frame + 1, 4)) << info.name;
      EXPECT_GE(standing_ids.size(), 1U) << info.name;
      reduced += reduced_ids.size();
      EXPECT_EQ(recorded.manifolds.at(0).points.size(), standing_ids.size()) << info.name;
      for (const std::string& id : reduced_ids)
        EXPECT_FALSE(standing_ids.contains(id)) << info.name;
    }
    EXPECT_EQ(pair.persistent().points.size(), 4U) << info.name;
    EXPECT_GT(reduced, 0U) << info.name;
  }
}

TEST(IncrementalManifold, WithoutAReducerAllCornersOfAPrismStay) {
  Stepped<double> pair(make_cylinder(0.5, 0.5, 24), box(2, 0.5, 2),
                       {Confirm::Distance, 0.02, 1e-3});
  pair.options().reducer = nullptr;
  for (int frame = 0; frame < 30; ++frame) {
    EXPECT_EQ(pair.step(standing(), at(0, 0, 0)).points.size(),
              static_cast<std::size_t>(std::min(frame + 1, 24)));
  }
}

TEST(IncrementalManifold, WithoutAReducerTheNewestAreKeptUpToTheMostThatThereIsRoomFor) {
  Stepped<double> pair(make_cylinder(0.5, 0.5, 100), box(2, 0.5, 2),
                       {Confirm::Distance, 0.02, 1e-3});
  pair.options().reducer = nullptr;
  std::string first;
  for (int frame = 0; frame < 65; ++frame) {
    const trace::Pair recorded = pair.record(standing(), at(0, 0, 0));
    const std::vector<trace::Point>& points = recorded.manifolds.at(0).points;
    if (frame == 0) first = points.at(0).id;
    ASSERT_EQ(points.size(), std::min<std::size_t>(frame + 1, kMaxPersistentPoints));
    if (frame < 64) continue;
    const trace::PersistentPoint& gone = recorded.incremental->points.back();
    EXPECT_EQ(gone.point.id, first) << "the oldest";
    EXPECT_EQ(gone.reason, "reduced");
    EXPECT_EQ(recorded.incremental->points.at(63).state, "new");
  }
}

TEST(IncrementalManifold, WithoutAReducerABoxThatTurnsKeepsItsFourCorners) {
  Stepped<double> pair(box(0.5, 0.5, 0.5), box(20, 0.5, 2), {Confirm::Distance, 0.02, 1e-3});
  pair.options().reducer = nullptr;
  // Turning in place gives different places, and old points persist.
  std::size_t most = 0;
  for (int frame = 0; frame < 400; ++frame)
    most = std::max(most, pair.step(standing(1e-5 * frame), at(0, 0, 0)).points.size());
  EXPECT_EQ(most, 4U);  // equal features are the same point
}

TEST(IncrementalManifold, EveryPenetrationMethodReportsItsNameAndASimilarDepth) {
  for (const PenetrationMethod method : {PenetrationMethod::Sat, PenetrationMethod::Epa,
                                         PenetrationMethod::Mpr, PenetrationMethod::Sampling}) {
    Stepped<double> pair(box(0.5, 0.5, 0.5), box(2, 0.5, 2));
    pair.incremental().penetration = method;
    const trace::Pair recorded = pair.record(at(0.1, 0.9, 0.2), at(0, 0, 0));
    EXPECT_EQ(recorded.incremental->query, to_string(method));
    ASSERT_EQ(recorded.penetration.has_value(), method != PenetrationMethod::Sat);
    if (recorded.penetration) {
      EXPECT_EQ(recorded.penetration->method, to_string(method));
      EXPECT_NEAR(recorded.penetration->depth, 0.06, 1e-3);  // of the cores
    }
    EXPECT_NEAR(recorded.manifolds.at(0).points.at(0).separation, -0.1, 1e-3) << to_string(method);
  }
}

TEST(IncrementalManifold, NumbersThatAreNotFiniteGiveNothing) {
  Stepped<double> pair(box(0.5, 0.5, 0.5), ball(1));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(pair.step(at(nan, 0, 0), at(0, 0, 0)).points.empty());
}

}  // namespace
}  // namespace contactscope::test
