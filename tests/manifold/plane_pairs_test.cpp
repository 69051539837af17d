#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "geometry/hull_builder.h"
#include "manifold/placed_shapes.h"
#include "support/builders.h"

namespace contactscope {
namespace {

using test::kDegree;
using test::PlacedShapes;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

template <class S> class PlanePairs : public testing::Test {
 protected:
  static constexpr double kEps = std::numeric_limits<S>::epsilon();
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(PlanePairs, Scalars);

/// A box of side 1 with its lowest point `depth` below the ground.
PlacedShapes box_on_ground(const Quatd& rotation, double depth) {
  const Hull<double> box = test::cube(0.5);
  double lowest = 0;
  for (const Vec3d& vertex : box.vertices) lowest = std::min(lowest, (rotation * vertex).y());
  return {box, {rotation, Vec3d(0, -lowest - depth, 0)}, test::ground(), {}};
}

TYPED_TEST(PlanePairs, SphereHasOnePointBelowItsCentreOnThePlaneWhereverThePairIs) {
  using S = TypeParam;
  test::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const double size = random.decade(-4, 4);
    const double height = random.uniform(-3, 1);  // up to 3 sizes below the ground
    const Pose<double> by = random.pose(size);
    const Manifold<S> manifold =
        test::manifold_of<S>(test::moved({test::ball(size),
                                          {random.rotation(), Vec3d(2, height, -1) * size},
                                          test::ground(),
                                          test::at(0, 0, 0)},
                                         by));
    const double rounding = 64 * this->kEps * size;
    if (std::abs(height - 1) * size < rounding) continue;
    ASSERT_EQ(manifold.points.size(), 1u);
    EXPECT_LT((test::normal_of(manifold) - by.rotate(-Vec3d::UnitY())).norm(), 8 * this->kEps);
    EXPECT_NEAR(manifold.points[0].separation, (height - 1) * size, rounding);
    EXPECT_LT((test::position_of(manifold, 0) - by.transform(Vec3d(2, 0, -1) * size)).norm(),
              rounding);
    EXPECT_EQ(manifold.axis, AxisKind::FaceB);
    EXPECT_EQ(manifold.type, ContactType::PointFace);
    EXPECT_THAT(test::ids_of(manifold), ElementsAre("a:v0 b:f0"));
  }
}

TYPED_TEST(PlanePairs, NothingTouchesAboveThePlaneButWithinTheMargin) {
  using S = TypeParam;
  const Shape<double> shapes[] = {test::ball(1), test::lying_capsule(2, 1), test::cube(1)};
  CollideOptions margin;
  margin.margin = S(0.1);
  for (const Shape<double>& shape : shapes) {
    const PlacedShapes pair{shape, test::at(0, 1.05, 0), test::ground(), {}};
    EXPECT_TRUE(test::manifold_of<S>(pair).points.empty());
    EXPECT_NEAR(test::record_of<S>(pair).separation, 0.05, 8 * this->kEps);
    const Manifold<S> near = test::manifold_of<S>(pair, margin);
    ASSERT_FALSE(near.points.empty());
    for (std::size_t i = 0; i < near.points.size(); ++i) {
      EXPECT_NEAR(near.points[i].separation, 0.05, 8 * this->kEps);
      EXPECT_NEAR(test::position_of(near, i).y(), 0, 8 * this->kEps);
    }
  }
}

// Any four evenly spread corners of a drum's twelve are equally good. The ones selected in the
// frame before stay, in either order of the shapes.
TYPED_TEST(PlanePairs, PointsThatWereKeptBeforeStayInEitherOrder) {
  using S = TypeParam;
  std::vector<Vec3d> corners;
  for (int k = 0; k < 24; ++k) {
    const double angle = (k / 2) * std::numbers::pi / 6;
    corners.emplace_back(std::cos(angle), k % 2 == 0 ? 0.5 : -0.5, std::sin(angle));
  }
  const PlacedShapes there{build_hull(corners), test::at(0, 0.49, 0), test::ground(), {}};
  for (const PlacedShapes& pair :
       {there, PlacedShapes{there.b, there.pose_b, there.a, there.pose_a}}) {
    CollideOptions options;
    options.reducer = find_reducer("coherent");
    options.reduction.max_points = 12;
    std::vector<ContactPoint<S>> all;
    for (const ContactPoint<S>& point : test::manifold_of<S>(pair, options).points)
      all.push_back(point);
    ASSERT_EQ(all.size(), 12u);
    std::ranges::sort(all, {}, [](const ContactPoint<S>& point) {
      return std::atan2(point.position.z(), point.position.x());
    });
    options.reduction.max_points = 4;
    for (const std::size_t first : {0u, 1u, 2u}) {
      const std::vector<FeatureId> kept{all[first].id, all[first + 3].id, all[first + 6].id,
                                        all[first + 9].id};
      options.reduction.previous = kept;
      std::vector<std::string> before;
      for (const FeatureId& id : kept) before.push_back(to_string(id));
      EXPECT_EQ(test::ids_of(test::manifold_of<S>(pair, options)), before);
    }
  }
}

TYPED_TEST(PlanePairs, LyingCapsuleHasAPointBelowEachEnd) {
  using S = TypeParam;
  const Manifold<S> manifold =
      test::manifold_of<S>({test::lying_capsule(2, 0.5), test::at(1, 0.49, 0), test::ground(), {}});
  ASSERT_EQ(manifold.points.size(), 2u);
  EXPECT_EQ(manifold.type, ContactType::EdgeFace);
  EXPECT_THAT(test::ids_of(manifold), ElementsAre("a:v0 b:f0", "a:v1 b:f0"));
  const double rounding = 8 * this->kEps;
  EXPECT_LT((test::position_of(manifold, 0) - Vec3d(-1, 0, 0)).norm(), rounding);
  EXPECT_LT((test::position_of(manifold, 1) - Vec3d(3, 0, 0)).norm(), rounding);
  for (const ContactPoint<S>& point : manifold.points) {
    EXPECT_NEAR(point.separation, -0.01, rounding);
  }
}

TYPED_TEST(PlanePairs, TiltedCapsuleTouchesWithAPointAlsoWhenBothEndsAreUnder) {
  using S = TypeParam;
  PlacedShapes pair{test::lying_capsule(2, 0.5), {}, test::ground(), {}};
  pair.pose_a.rotation = test::about(Vec3d::UnitZ(), 5 * kDegree);  // second end up
  pair.pose_a.position.y() = 0.5 - 0.1 + 2 * std::sin(5 * kDegree);
  Manifold<S> manifold = test::manifold_of<S>(pair);
  EXPECT_EQ(manifold.type, ContactType::PointFace);
  EXPECT_THAT(test::ids_of(manifold), ElementsAre("a:v0 b:f0"));
  EXPECT_NEAR(test::deepest_of(manifold), -0.1, 16 * this->kEps);

  pair.pose_a.position.y() -= 0.3;
  manifold = test::manifold_of<S>(pair);
  EXPECT_EQ(manifold.type, ContactType::PointFace);
  EXPECT_EQ(manifold.points.size(), 2u);
  EXPECT_NEAR(test::deepest_of(manifold), -0.4, 16 * this->kEps);
}

TYPED_TEST(PlanePairs, CapsuleOfLengthZeroHasThePointOfASphere) {
  using S = TypeParam;
  const Manifold<S> manifold = test::manifold_of<S>(
      {test::upright_capsule(0, 0.5), test::at(1, 0.4, 2), test::ground(), {}});
  ASSERT_EQ(manifold.points.size(), 1u);
  EXPECT_EQ(manifold.type, ContactType::PointFace);
  EXPECT_NEAR(manifold.points[0].separation, -0.1, 4 * this->kEps);
}

TYPED_TEST(PlanePairs, BoxOnAFaceAnEdgeAndACornerIsNamedSo) {
  using S = TypeParam;
  const Quatd on_edge = test::about(Vec3d::UnitX(), 45 * kDegree);
  const Quatd on_corner = Quatd::FromTwoVectors(Vec3d(1, 1, 1), Vec3d::UnitY()) * Quatd::Identity();
  for (const double depth : {0.001, 0.02, 0.2}) {
    for (const Preference preference : {Preference::Relative, Preference::None}) {
      CollideOptions options;
      options.preference = preference;
      const Manifold<S> face =
          test::manifold_of<S>(box_on_ground(Quatd::Identity(), depth), options);
      EXPECT_EQ(face.type, ContactType::FaceFace);
      EXPECT_EQ(face.points.size(), 4u);
      const Manifold<S> edge = test::manifold_of<S>(box_on_ground(on_edge, depth), options);
      EXPECT_EQ(edge.type, ContactType::EdgeFace);
      EXPECT_EQ(edge.points.size(), 2u);
      const Manifold<S> corner = test::manifold_of<S>(box_on_ground(on_corner, depth), options);
      EXPECT_EQ(corner.type, ContactType::PointFace);
      EXPECT_EQ(corner.points.size(), 1u);
      EXPECT_NEAR(test::deepest_of(corner), -depth, 8 * this->kEps);
    }
  }
  // So deep that the corner's neighbours are below the ground too.
  const Manifold<S> sunk = test::manifold_of<S>(box_on_ground(on_corner, 0.7));
  EXPECT_EQ(sunk.points.size(), 4u);
  EXPECT_EQ(sunk.type, ContactType::PointFace);
}

TYPED_TEST(PlanePairs, TypeForgivesAnInvisibleTiltUnlessPreferenceIsOff) {
  using S = TypeParam;
  CollideOptions strict;
  strict.preference = Preference::None;
  const PlacedShapes nearly_level =
      box_on_ground(test::about(Vec3d::UnitX(), 0.05 * kDegree), 0.01);
  EXPECT_EQ(test::manifold_of<S>(nearly_level).type, ContactType::FaceFace);
  EXPECT_EQ(test::manifold_of<S>(nearly_level, strict).type, ContactType::EdgeFace);
  const PlacedShapes tilted = box_on_ground(test::about(Vec3d::UnitX(), 0.5 * kDegree), 0.01);
  EXPECT_EQ(test::manifold_of<S>(tilted).type, ContactType::EdgeFace);
  EXPECT_EQ(test::manifold_of<S>(tilted).points.size(), 4u);
}

TYPED_TEST(PlanePairs, SlowEveryVertexBelowThePlaneIsAPointUnderIt) {
  using S = TypeParam;
  test::Random random(2);
  int touching = 0;
  for (int i = 0; i < 3000; ++i) {
    const double size = random.decade(-4, 4);
    const Hull<double> hull = random.chance(0.5)
                                  ? test::random_box(random, size, 20)
                                  : test::random_hull(random, 4 + random.index(40), size, 5);
    const Shape<double> plane =
        HalfSpace<double>{{random.unit_vector(), size * random.uniform(-2, 2)}};
    const PlacedShapes pair =
        test::rounded<S>({hull, random.pose(size), plane, random.pose(2 * size)});
    const Plane<double> local = std::get<HalfSpace<double>>(pair.b).plane;
    const Vec3d normal = pair.pose_b.rotate(local.normal);
    const double offset = local.offset + normal.dot(pair.pose_b.position);
    const double rounding = 64 * this->kEps * size;

    const Manifold<S> manifold = test::manifold_of<S>(pair);
    std::size_t next = 0;
    bool uncertain = false;
    const Hull<double>& given = std::get<Hull<double>>(pair.a);
    for (int v = 0; v < given.vertex_count(); ++v) {
      const Vec3d vertex = pair.pose_a.transform(given.vertices[static_cast<std::size_t>(v)]);
      const double height = normal.dot(vertex) - offset;
      if (std::abs(height) < rounding) uncertain = true;
      if (uncertain) break;
      if (height > 0) continue;
      ASSERT_LT(next, manifold.points.size());
      const ContactPoint<S>& point = manifold.points[next++];
      ASSERT_EQ(point.id, FeatureId::of(vertex_ref(Owner::A, v), face_ref(Owner::B, 0)));
      ASSERT_NEAR(point.separation, height, rounding);
      const Vec3d below = vertex - height * normal;
      ASSERT_LT((point.position.template cast<double>() - below).norm(), rounding);
    }
    if (uncertain) continue;
    ASSERT_EQ(next, manifold.points.size()) << "pair " << i;
    if (next == 0) continue;
    ++touching;
    ASSERT_LT((test::normal_of(manifold) + normal).norm(), 16 * this->kEps);
  }
  EXPECT_GT(touching, 1000);
}

TYPED_TEST(PlanePairs, APlaneIsTheTopOfAWideBox) {
  using S = TypeParam;
  test::Random random(3);
  const Hull<double> slab = make_box(Vec3d(20, 20, 20));
  for (int i = 0; i < 500; ++i) {
    const Quatd rotation = test::about(Vec3d::UnitY(), random.uniform(0, 6)) *
                           random.rotation_by(random.uniform(0, 0.1));
    PlacedShapes pair = box_on_ground(rotation, random.uniform(0.01, 0.1));
    const Manifold<S> on_plane = test::manifold_of<S>(pair);
    pair.b = slab;
    pair.pose_b.position.y() = -20;
    CollideOptions options;
    options.preference = Preference::None;
    const Manifold<S> on_box = test::manifold_of<S>(pair, options);
    ASSERT_EQ(on_box.axis, AxisKind::FaceB);
    const double rounding = 16 * this->kEps * 20;
    // A box also keeps corners above its face within rounding: depth_rounding() of both extents.
    const std::vector<Vec3d>& corners = std::get<Hull<double>>(pair.a).vertices;
    const bool is_uncertain = std::ranges::any_of(corners, [&](const Vec3d& corner) {
      return std::abs(pair.pose_a.transform(corner).y()) < 8 * rounding;
    });
    if (!is_uncertain) {
      ASSERT_EQ(on_plane.points.size(), on_box.points.size());
    }
    EXPECT_LT((test::normal_of(on_plane) - test::normal_of(on_box)).norm(), 8 * this->kEps);
    for (std::size_t k = 0; k < on_plane.points.size(); ++k) {
      EXPECT_LT(test::distance_to_nearest(on_box, test::position_of(on_plane, k)), rounding);
    }
    EXPECT_NEAR(test::deepest_of(on_plane), test::deepest_of(on_box), rounding);
  }
}

TYPED_TEST(PlanePairs, ReducerLeavesFourOfTheCornersOfASunkenBox) {
  using S = TypeParam;
  CollideOptions options;
  options.reducer = find_reducer("area");
  const PlacedShapes pair = box_on_ground(test::about(Vec3d(1, 0, 1), 3 * kDegree), 2);
  EXPECT_EQ(test::manifold_of<S>(pair).points.size(), 8u);
  EXPECT_EQ(test::manifold_of<S>(pair, options).points.size(), 4u);
  const trace::Pair record = test::record_of<S>(pair, options);
  ASSERT_TRUE(record.reduction.has_value());
  EXPECT_EQ(record.reduction->points.size(), 8u);
}

TYPED_TEST(PlanePairs, TheDeepestVerticesAreKeptInOrderIfThereAreTooMany) {
  using S = TypeParam;
  std::vector<Vec3d> points;
  for (int i = 0; i < 400; ++i) {  // a spiral over the sphere
    const double y = 1 - 2 * (i + 0.5) / 400;
    const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    points.push_back(
        {std::sqrt(1 - y * y) * std::cos(angle), y, std::sqrt(1 - y * y) * std::sin(angle)});
  }
  const Hull<double> hull = build_hull(points);
  ASSERT_EQ(hull.vertex_count(), 400);
  const Manifold<S> manifold = test::manifold_of<S>({hull, test::at(0, -3, 0), test::ground(), {}});
  ASSERT_EQ(manifold.points.size(), kMaxManifoldPoints);
  std::vector<double> heights;
  for (const Vec3d& vertex : hull.vertices) heights.push_back(vertex.y() - 3);
  std::sort(heights.begin(), heights.end());
  std::uint32_t last = 0;
  for (std::size_t k = 0; k < manifold.points.size(); ++k) {
    EXPECT_LE(manifold.points[k].separation, heights[kMaxManifoldPoints - 1] + 1e-6);
    const std::uint32_t vertex = manifold.points[k].id.first.index;
    if (k > 0) {
      EXPECT_GT(vertex, last);
    }
    last = vertex;
  }
  EXPECT_NEAR(test::deepest_of(manifold), heights[0], 1e-6);
}

TYPED_TEST(PlanePairs, PointsMoveNoFasterThanTheBodyAsItTiltsThroughLevel) {
  using S = TypeParam;
  const Shape<double> shapes[] = {test::lying_capsule(0.5, 0.2), test::cube(0.5)};
  const double step = 1e-4;
  for (const Shape<double>& shape : shapes) {
    PlacedShapes pair{shape, test::at(0, 0.1, 0), test::ground(), {}};
    Manifold<S> before;
    for (int i = -100; i <= 100; ++i) {
      pair.pose_a.rotation = test::about(Vec3d(0.3, 0, 1), i * step);
      const Manifold<S> now = test::manifold_of<S>(pair);
      if (i > -100) {
        ASSERT_EQ(test::ids_of(now), test::ids_of(before));
        for (std::size_t k = 0; k < now.points.size(); ++k) {
          const Vec3d moved = test::position_of(now, k) - test::position_of(before, k);
          ASSERT_LT(moved.norm(), 2 * step);
        }
        ASSERT_NEAR(test::deepest_of(now), test::deepest_of(before), 2 * step);
      }
      before = now;
    }
  }
}

}  // namespace
}  // namespace contactscope
