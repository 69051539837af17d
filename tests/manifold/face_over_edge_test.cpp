#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "geometry/primitives.h"
#include "manifold/collide_pairs.h"
#include "manifold/dispatch.h"
#include "support/builders.h"
#include "support/cases.h"
#include "support/random_geometry.h"

// If faces lie in parallel planes, the edges around them cross along the same axis. Rounding must
// not select these edges: they give a single point, which may be on neither shape.
namespace contactscope {
namespace {

using test::Random;

/// Half extents and centre along the world's axes, in numbers that are exact in every scalar.
struct Level {
  Vec3d half, middle;
};

/// A box that is axis-aligned in the world, with half extents in its own frame.
struct TurnedBox {
  Vec3d half;
  Pose<double> pose;

  Level level() const {
    const Mat3<double> turned = pose.rotation.toRotationMatrix();
    return {(turned * half).cwiseAbs().array().round(), pose.position};
  }
};

/// Largest distance by which a coordinate of the point is outside a box, metres; 0 inside.
double outside(const Level& box, const Vec3d& point) {
  const Vec3d beyond = (point - box.middle).cwiseAbs() - box.half;
  return std::max(beyond.maxCoeff(), 0.0);
}

/// Overlap along each of the world's axes, metres.
Vec3d overlaps(const Level& a, const Level& b) {
  return a.half + b.half - (b.middle - a.middle).cwiseAbs();
}

/// Through the table of pairs, and as general hulls: every point is on both boxes, and the deepest
/// one is as deep as the overlap along the best of the world's axes.
template <class S> void expect_points_on_both(const TurnedBox& a, const TurnedBox& b) {
  const Level level_a = a.level(), level_b = b.level();
  const double depth = overlaps(level_a, level_b).minCoeff();
  const double rounding =
      64 * static_cast<double>(std::numeric_limits<S>::epsilon()) *
      (a.half.norm() + b.half.norm() + a.pose.position.norm() + b.pose.position.norm());
  CollideOptions options;
  options.preference = Preference::None;
  const Hull<S> hull_a = hull_cast<S>(make_box(a.half)), hull_b = hull_cast<S>(make_box(b.half));
  const Pose<S> pose_a = a.pose.cast<S>(), pose_b = b.pose.cast<S>();
  Manifolds<S> manifolds;
  collide<S>(Shape<S>(hull_a), pose_a, Shape<S>(hull_b), pose_b, options, manifolds);
  ASSERT_EQ(manifolds.size(), 1u);
  for (const Manifold<S>& manifold :
       {manifolds.front(), collide_hull_hull(hull_a, pose_a, hull_b, pose_b, options)}) {
    ASSERT_FALSE(manifold.points.empty());
    S deepest = std::numeric_limits<S>::infinity();
    for (const ContactPoint<S>& point : manifold.points) {
      const Vec3d at = point.position.template cast<double>();
      // Points lie on the reference face; the other box's point is below it by the depth.
      const bool is_of_a = manifold.axis == AxisKind::FaceA;
      const Vec3d below = at + (is_of_a ? 1.0 : -1.0) * static_cast<double>(point.separation) *
                                   manifold.normal.template cast<double>();
      ASSERT_LE(outside(level_a, is_of_a ? at : below), rounding);
      ASSERT_LE(outside(level_b, is_of_a ? below : at), rounding);
      deepest = std::min(deepest, point.separation);
    }
    ASSERT_NEAR(static_cast<double>(deepest), -depth, rounding);
    ASSERT_NE(manifold.axis, AxisKind::EdgeEdge);
  }
}

template <class S> class FaceOverEdge : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(FaceOverEdge, Scalars);

TYPED_TEST(FaceOverEdge, BoxesAtAQuarterTurnTouchWithFaces) {
  const TurnedBox a{{1, 2, 2}, {test::about(Vec3d::UnitY(), test::kDegree * 90), {4, -8, 0}}};
  const TurnedBox b{{3, 2, 3}, {test::about(Vec3d::UnitX(), test::kDegree * 90), {3, -11, -2}}};
  expect_points_on_both<TypeParam>(a, b);
}

TurnedBox random_turned_box(Random& random) {
  TurnedBox box;
  for (int k = 0; k < 3; ++k) box.half[k] = 1 + random.index(4);
  for (int turns = random.index(3); turns > 0; --turns) {
    const Quatd quarter =
        test::about(Vec3d(Vec3d::Unit(random.index(3))), test::kDegree * 90 * random.index(4));
    box.pose.rotation = (quarter * box.pose.rotation).normalized();
  }
  for (int k = 0; k < 3; ++k) box.pose.position[k] = random.index(25) - 12;
  return box;
}

TYPED_TEST(FaceOverEdge, SlowNoPointIsOffTwoLevelBoxesThatOverlap) {
  Random random(34);
  int overlapping = 0;
  for (int i = 0; overlapping < test::cases(20'000); ++i) {
    SCOPED_TRACE("pair " + std::to_string(i));
    const TurnedBox a = random_turned_box(random);
    TurnedBox b = random_turned_box(random);
    for (int k = 0; k < 3; ++k) b.pose.position[k] = a.pose.position[k] + random.index(11) - 5;
    if (overlaps(a.level(), b.level()).minCoeff() < 1) continue;
    ++overlapping;
    expect_points_on_both<TypeParam>(a, b);
    if (testing::Test::HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace contactscope
