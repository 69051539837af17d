#include <gtest/gtest.h>

#include "support/builders.h"

namespace contactscope {
namespace {

using test::collide;
using test::crossed_edges;
using test::deepest;
using test::PairCase;

template <class S> class EdgeContact : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(EdgeContact, Scalars);

TYPED_TEST(EdgeContact, CrossedCubesTouchInTheMiddleBetweenTheirEdges) {
  using S = TypeParam;
  const PairCase<double> pair = crossed_edges(1, 0.01);
  const Manifold<S> manifold = collide(pair.cast<S>());
  EXPECT_EQ(manifold.axis, AxisKind::EdgeEdge);
  ASSERT_EQ(manifold.points.size(), 1u);
  const ContactPoint<S>& point = manifold.points[0];
  const double rounding = 16 * std::numeric_limits<S>::epsilon();
  EXPECT_NEAR(point.separation, -0.01, rounding);
  EXPECT_NEAR(manifold.normal.y(), 1, rounding);
  const Vec3d expected(0, std::numbers::sqrt2 / 2 - 0.005, 0);
  EXPECT_LT((point.position.template cast<double>() - expected).norm(), rounding);
  EXPECT_EQ(point.id.first.owner, Owner::A);
  EXPECT_EQ(point.id.second.owner, Owner::B);
}

TYPED_TEST(EdgeContact, EdgesThatCrossOffTheMiddle) {
  using S = TypeParam;
  PairCase<double> pair = crossed_edges(1, 0.01);
  pair.pose_b.position += Vec3d(0.3, 0, -0.2);
  const Manifold<S> manifold = collide(pair.cast<S>());
  ASSERT_EQ(manifold.points.size(), 1u);
  // A's edge is the line z = 0; B's runs through (0.3, -0.2) at 80 degrees about y from x.
  const double along = -0.2 / std::sin(80 * test::kDegree);
  const double x = 0.3 + along * std::cos(80 * test::kDegree);
  EXPECT_NEAR(manifold.points[0].position.x(), x, 32 * std::numeric_limits<S>::epsilon());
  EXPECT_NEAR(manifold.points[0].position.z(), 0, 32 * std::numeric_limits<S>::epsilon());
}

TYPED_TEST(EdgeContact, IsTheSameFromATenthOfAMillimetreToTenKilometres) {
  using S = TypeParam;
  const Manifold<S> metre = collide(crossed_edges(1, 0.01).cast<S>());
  ASSERT_EQ(metre.points.size(), 1u);
  for (const double side : {1e-6, 1e-4, 1e-2, 1e2, 1e4, 1e6}) {
    const Manifold<S> scaled = collide(crossed_edges(side, 0.01 * side).cast<S>());
    ASSERT_EQ(scaled.points.size(), 1u) << side;
    EXPECT_EQ(scaled.axis, AxisKind::EdgeEdge);
    EXPECT_EQ(scaled.points[0].id, metre.points[0].id);
    const double rounding = 32 * std::numeric_limits<S>::epsilon();
    EXPECT_NEAR(scaled.points[0].separation / side, -0.01, rounding) << side;
    const Vec3d position = scaled.points[0].position.template cast<double>() / side;
    EXPECT_LT((position - metre.points[0].position.template cast<double>()).norm(), rounding);
    EXPECT_LT((scaled.normal - metre.normal).norm(), rounding);
  }
}

TYPED_TEST(EdgeContact, ScalingByAPowerOfTwoScalesEveryBit) {
  using S = TypeParam;
  const PairCase<S> metre = crossed_edges(1, 0.01).cast<S>();
  const Manifold<S> expected = collide(metre);
  ASSERT_EQ(expected.points.size(), 1u);
  for (const S scale : {S(0x1p-13), S(0x1p-7), S(0x1p13)}) {
    PairCase<S> scaled = metre;
    for (Hull<S>* hull : {&scaled.a, &scaled.b}) {
      for (Vec3<S>& vertex : hull->vertices) vertex *= scale;
      for (Plane<S>& plane : hull->planes) plane.offset *= scale;
      hull->centroid *= scale;
      hull->radius *= scale;
      lay_out(*hull);
    }
    scaled.pose_b.position *= scale;
    const Manifold<S> manifold = collide(scaled);
    ASSERT_EQ(manifold.points.size(), 1u);
    EXPECT_EQ(manifold.points[0].separation, scale * expected.points[0].separation);
    EXPECT_EQ(manifold.points[0].position, Vec3<S>(scale * expected.points[0].position));
    EXPECT_EQ(manifold.normal, expected.normal);
  }
}

TYPED_TEST(EdgeContact, NearlyParallelEdgesKeepThePointOnBothEdges) {
  using S = TypeParam;
  // Roof ridge along roof ridge, crossing at angles down to the noise of the scalar.
  for (double angle = 1e-8; angle < 0.2; angle *= 2) {
    PairCase<double> pair = crossed_edges(1, 0.01);
    pair.pose_b.rotation =
        test::about(Vec3d::UnitY(), angle) * test::about(Vec3d::UnitX(), 45 * test::kDegree);
    const Manifold<S> manifold = collide(pair.cast<S>());
    ASSERT_FALSE(manifold.points.empty()) << angle;
    for (const ContactPoint<S>& point : manifold.points) {
      EXPECT_LE(std::abs(point.position.x()), S(0.6)) << angle;
      EXPECT_LE(std::abs(point.position.z()), S(0.6)) << angle;
    }
    // Ridge on ridge overlaps by 1 cm; sideways, face against face, by 1 / sqrt 2 of that.
    EXPECT_LE(deepest(manifold), -0.0069) << angle;
    EXPECT_GE(deepest(manifold), -0.0110) << angle;
  }
}

}  // namespace
}  // namespace contactscope
